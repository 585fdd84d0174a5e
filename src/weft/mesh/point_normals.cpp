#include "weft/mesh/point_normals.h"

namespace weft {

std::vector<Vec3f> point_normals(std::span<const Vec3f> points,
                                 std::span<const Triangle> triangles) {
  std::vector<Vec3d> sums(points.size());
  const auto at = [&](int v) { return vec_cast<double>(points[static_cast<std::size_t>(v)]); };
  for (const auto& [a, b, c] : triangles) {
    const Vec3d area = cross(at(b) - at(a), at(c) - at(a));
    for (const int v : {a, b, c}) sums[static_cast<std::size_t>(v)] += area;
  }
  std::vector<Vec3f> normals;
  normals.reserve(points.size());
  for (const Vec3d& sum : sums) {
    const Vec3d normal = normalized(sum);
    normals.push_back(vec_cast<float>(squared_length(normal) > 0 ? normal : Vec3d{0, 1, 0}));
  }
  return normals;
}

}  // namespace weft
