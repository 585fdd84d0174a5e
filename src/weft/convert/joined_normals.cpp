#include "weft/convert/joined_normals.h"

#include <algorithm>
#include <span>

#include "weft/convert/sample.h"

namespace weft {
namespace {

/// The vertices of each point.
std::vector<std::vector<int>> vertices_of_points(const std::vector<int>& joined) {
  std::vector<std::vector<int>> points(1 + *std::max_element(joined.begin(), joined.end()));
  for (std::size_t v = 0; v < joined.size(); ++v) points[joined[v]].push_back(static_cast<int>(v));
  return points;
}

/// Gives vertices by which the cut split edges of the border, which have later numbers than those
/// of the surface, what lies between the ends of the edge.
void interpolate_along_border(const DiskMesh& disk, std::span<const char> known,
                              std::vector<Vec3d>& normals) {
  const int count = static_cast<int>(disk.border.size());
  const auto vertex = [&](int k) { return disk.border[(k + count) % count]; };
  for (int k = 0; k < count; ++k) {
    if (known[vertex(k)] != 0) continue;
    int before = k - 1, after = k + 1;
    while (before > k - count && known[vertex(before)] == 0) --before;
    while (after < k + count && known[vertex(after)] == 0) ++after;
    const int a = vertex(before), b = vertex(after), own = vertex(k);
    const double from = length(disk.positions[own] - disk.positions[a]),
                 to = length(disk.positions[own] - disk.positions[b]);
    if (known[a] != 0 && known[b] != 0 && from + to > 0)
      normals[own] = normalized(to * normals[a] + from * normals[b]);
  }
}

}  // namespace

JoinedNormals::JoinedNormals(const RepairedMesh& surface) {
  const TriangleMesh& mesh = surface.mesh;
  normals_ = angle_weighted_normals(mesh.positions, mesh.triangles);
  if (surface.joined.empty()) return;
  const std::vector<Vec3d> own = normals_;
  for (const std::vector<int>& vertices : vertices_of_points(surface.joined))
    for (const int v : vertices)
      for (const int other : vertices)
        if (other != v && dot(own[v], own[other]) > 0) normals_[v] += own[other];
}

std::vector<Vec3d> JoinedNormals::of(const DiskMesh& disk, const Piece& piece) const {
  std::vector<Vec3d> normals = disk_vertex_normals(disk);
  std::vector<char> known(normals.size(), 0);
  const int vertices = static_cast<int>(piece.vertex.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const int point = disk.surface_vertex[v];
    if (point >= vertices || !(squared_length(normals_[piece.vertex[point]]) > 0)) continue;
    normals[v] = normalized(normals_[piece.vertex[point]]);
    known[v] = 1;
  }
  interpolate_along_border(disk, known, normals);
  return normals;
}

}  // namespace weft
