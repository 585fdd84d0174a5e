#include "weft/convert/vertex_normals.h"

#include <algorithm>

#include "weft/core/math.h"

namespace weft {

std::vector<Vec3d> disk_vertex_normals(const DiskMesh& disk) {
  int count = 0;
  for (const int s : disk.surface_vertex) count = std::max(count, s + 1);
  std::vector<Vec3d> sums(static_cast<std::size_t>(count));
  for (const Triangle& t : disk.triangles) {
    const std::array<Vec3d, 3> p{disk.positions[t[0]], disk.positions[t[1]], disk.positions[t[2]]};
    const Vec3d normal = normalized(cross(p[1] - p[0], p[2] - p[0]));
    for (int k = 0; k < 3; ++k) {
      const Vec3d to_next = normalized(p[(k + 1) % 3] - p[k]);
      const Vec3d to_last = normalized(p[(k + 2) % 3] - p[k]);
      sums[disk.surface_vertex[t[k]]] += arc_cosine(dot(to_next, to_last)) * normal;
    }
  }
  for (Vec3d& sum : sums) sum = squared_length(sum) > 0 ? normalized(sum) : Vec3d{0, 1, 0};
  std::vector<Vec3d> normals;
  normals.reserve(disk.surface_vertex.size());
  for (const int s : disk.surface_vertex) normals.push_back(sums[s]);
  return normals;
}

}  // namespace weft
