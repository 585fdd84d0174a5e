#pragma once

#include <optional>
#include <vector>

#include "weft/convert.h"
#include "weft/mesh.h"
#include "weft/run/export/bound_vertices.h"
#include "weft/sim/placement.h"

namespace weft {

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
