#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "weft/geometry_image.h"
#include "weft/mesh.h"
#include "weft/vec.h"

namespace weft {

/// Vertices and triangles of exported files, by samples of the grid: the same for every format and
/// frame, so that meshes and caches go together.
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

/// The same of panels with their seams closed: the triangles of the image, panel by panel, without
/// those that closing folds onto each other or to an edge.
/// @param sewn  mates of the image's charts with the seams closed
SurfacePoints sewn_points(const GeometryImage& image, const BorderMates& sewn);

/// The frames of a point cache, read one at a time.
class PointFrames {
 public:
  /// @throws InputError for what is no PC2 file or does not hold what it says
  explicit PointFrames(const std::filesystem::path& path);

  [[nodiscard]] int points() const { return points_; }
  [[nodiscard]] int frames() const { return frames_; }
  /// @pre 0 <= frame < frames()  @throws InputError when the file was cut since
  [[nodiscard]] std::vector<Vec3f> read(int frame);

 private:
  std::filesystem::path path_;
  std::ifstream in_;
  int points_ = 0, frames_ = 0;
};

}  // namespace weft
