#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "weft/convert.h"
#include "weft/mesh.h"
#include "weft/run/export/surface_points.h"
#include "weft/sim/placement.h"

namespace weft {

/// The vertices of a mesh, bound to the surface of the image that was made from it: each follows
/// its place in a triangle of the grid, and what lay between that place and the vertex at rest
/// turns along with the surface. So the rest shape comes back as it was, and detail that is finer
/// than the image stays.
class BoundVertices {
 public:
  struct Rest {
    const Planes3* samples = nullptr;  ///< [n x n] of the image, placed [m]
    std::span<const Vec2d> places;     ///< [V] in sample units; not finite: stays where it is
    std::span<const Vec3d> vertices;   ///< [V] of the mesh, placed [m]
  };
  /// @param grid  of the image, welded; must outlive this
  BoundVertices(const GeometryImage& image, const SurfacePoints& grid, const Rest& rest);

  /// Where the vertices are when the samples have moved. [V] [m]
  [[nodiscard]] std::vector<Vec3d> follow(const Planes3& samples) const;
  [[nodiscard]] int size() const { return static_cast<int>(bonds_.size()); }

 private:
  /// Of one vertex.
  struct Bond {
    std::array<int, 3> samples{-1, -1, -1};  ///< of its triangle; -1: bound to nothing
    std::array<double, 3> weights{};
    std::array<int, 2> along{};  ///< samples one column apart in that triangle
    Vec3d offset;                ///< in the frame of `Surface`, or the place of what is not bound
    Vec3d rounding;              ///< what is lost of the place at rest, added again
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

/// What of a surface is written: the samples of its image, or the vertices of the mesh that the
/// image was made from. The same vertices in the same order for every format and frame.
class ExportedSurface {
 public:
  /// The samples. @param grid  must outlive this
  ExportedSurface(const SurfacePoints& grid, const MeshFrame& files);

  struct Source {
    const GeometryImage* image = nullptr;
    const SourceMesh* mesh = nullptr;
    const Planes3* rest = nullptr;  ///< placed samples [m]
    PlacementMap placement;
  };
  /// The mesh's vertices. @param grid  welded; it and the mesh must outlive this
  ExportedSurface(const SurfacePoints& grid, const Source& source, const MeshFrame& files);

  [[nodiscard]] bool on_input() const { return bound_.has_value(); }
  [[nodiscard]] int vertices() const;
  /// Polygons and texture coordinates; made anew by every call where they are the samples'.
  [[nodiscard]] MeshFaces faces() const;
  /// Where the vertices are when the samples are there, in the unit and axes of files. [vertices]
  /// @param samples  [n x n] world [m]
  [[nodiscard]] std::vector<Vec3f> points(const Planes3& samples) const;
  /// What the numbers of files mean.
  [[nodiscard]] const MeshFrame& frame() const { return files_; }

 private:
  const SurfacePoints* grid_;
  const SourceMesh* mesh_ = nullptr;
  std::optional<BoundVertices> bound_;
  MeshFrame files_;
};

}  // namespace weft
