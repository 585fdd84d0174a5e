#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "weft/convert.h"
#include "weft/garment.h"
#include "weft/mesh.h"
#include "weft/run/export/surface_points.h"
#include "weft/sim/placement.h"

namespace weft {

/// Vertices of an input mesh, bound to the surface of its image. Each follows a point in a triangle
/// of the grid, and its offset from that point at rest rotates with the surface. So the rest shape
/// is reproduced, and detail finer than the image is kept.
class BoundVertices {
 public:
  struct Rest {
    const Planes3* samples = nullptr;  ///< [n x n] of the image, placed [m]
    std::span<const Vec2d> places;     ///< [V] in sample units; not finite: does not move
    std::span<const Vec3d> vertices;   ///< [V] of the mesh, placed [m]
  };
  /// @param grid  of the image, welded; must outlive this
  BoundVertices(const GeometryImage& image, const SurfacePoints& grid, const Rest& rest);

  /// Positions of the vertices for given samples. [V] [m]
  [[nodiscard]] std::vector<Vec3d> follow(const Planes3& samples) const;
  [[nodiscard]] int size() const { return static_cast<int>(bonds_.size()); }

 private:
  /// Binding of one vertex.
  struct Bond {
    std::array<int, 3> samples{-1, -1, -1};  ///< of its triangle; -1: not bound
    std::array<double, 3> weights{};
    std::array<int, 2> along{};  ///< samples one column apart in that triangle
    Vec3d offset;                ///< in the frame of `Surface`; not bound: the position [m]
    Vec3d rounding;              ///< error of the rest position, added again [m]
  };
  struct Frame {
    Vec3d origin, tangent, bitangent, normal;
    [[nodiscard]] Vec3d point(Vec3d offset) const {
      return origin + offset.x * tangent + offset.y * bitangent + offset.z * normal;
    }
  };
  class Surface;
  static Bond bond_at(Vec2d place, int size, const std::vector<bool>& rising);

  const SurfacePoints* grid_;
  std::vector<Triangle> welded_;  // [F] vertices of the grid
  std::vector<Bond> bonds_;       // [V]
};

/// Units of what is written of patterns, in a metre: centimetres.
inline constexpr float pattern_units = 100;

/// A named run of a surface's faces, or of vertices along a line.
struct NamedRun {
  std::string name;
  int first = 0, count = 0;     ///< of the faces
  std::vector<int> vertices{};  ///< of a line, in order
};

/// Panels and seams of a garment, as its mesh names them.
struct GarmentParts {
  std::vector<NamedRun> panels, seams;
};

/// The vertices of a surface that are written: the samples of its image, the vertices of its input
/// mesh, or those of a garment with its seams closed. They are the same, in the same order, for
/// every format and frame.
class ExportedSurface {
 public:
  /// Exports the samples. @param grid, image  must outlive this
  ExportedSurface(const SurfacePoints& grid, const GeometryImage& image, const MeshFrame& files);

  struct Source {
    const GeometryImage* image = nullptr;
    const SourceMesh* mesh = nullptr;
    const Planes3* rest = nullptr;  ///< placed samples [m]
    PlacementMap placement;
  };
  /// Exports the vertices of the mesh. @param grid  welded; it and the mesh must outlive this
  ExportedSurface(const SurfacePoints& grid, const Source& source, const MeshFrame& files);

  /// Exports a garment as one mesh: samples that are sewn together are one vertex, in their middle
  /// until they meet. Texture coordinates are the pattern's, in centimetres.
  /// @param grid  sewn_points; it and the garment must outlive this
  ExportedSurface(const SurfacePoints& grid, const Garment& garment, const MeshFrame& files);

  [[nodiscard]] int vertices() const;
  /// Panels and seams; nothing for what is no garment.
  [[nodiscard]] GarmentParts parts() const;
  /// Polygons and texture coordinates; computed by every call where the samples are exported.
  [[nodiscard]] MeshFaces faces() const;
  /// Linear RGB; empty where the image has none, and where it is not its samples that are exported.
  [[nodiscard]] std::vector<Vec3f> colours() const;
  /// Positions of the vertices for given samples, in the unit and axes of files. [vertices]
  /// @param samples  [n x n] world [m]
  [[nodiscard]] std::vector<Vec3f> points(const Planes3& samples) const;
  /// Unit and axes of files.
  [[nodiscard]] const MeshFrame& frame() const { return files_; }

 private:
  const SurfacePoints* grid_;
  const GeometryImage* image_ = nullptr;
  const SourceMesh* mesh_ = nullptr;
  const Garment* garment_ = nullptr;
  std::optional<BoundVertices> bound_;
  MeshFrame files_;
};

}  // namespace weft
