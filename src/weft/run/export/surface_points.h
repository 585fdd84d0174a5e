#pragma once

#include <vector>

#include "weft/geometry_image.h"
#include "weft/mesh.h"

namespace weft {

/// Which samples of a grid become vertices of exported files, and how they are joined: the same for
/// every format and frame, so that meshes and caches go together.
struct SurfacePoints {
  int size = 0;                     ///< n
  std::vector<int> sample_of;       ///< [V] the sample of each vertex
  std::vector<int> vertex_of;       ///< [n * n]
  std::vector<Triangle> triangles;  ///< [F] samples, mates not joined (for texture coordinates)

  /// Vertex positions. [V]
  [[nodiscard]] std::vector<Vec3f> gather(const Planes3& positions) const;
};

/// @param unwelded  every sample a vertex of its own; otherwise mates are one
SurfacePoints surface_points(const GeometryImage& image, bool unwelded);

}  // namespace weft
