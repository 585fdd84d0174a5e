#include "weft/cut/disk_mesh.h"

#include <algorithm>

#include "weft/core/assert.h"

namespace weft {

int add_split_vertex(DiskMesh& disk, const EdgePlace& place, Vec3d position, int surface_vertex) {
  const auto vertex = static_cast<int>(disk.positions.size());
  disk.split_from.resize(disk.positions.size());
  disk.split_from.push_back(place);
  disk.positions.push_back(position);
  disk.surface_vertex.push_back(surface_vertex);
  return vertex;
}
namespace {

int border_size(const CutDisk& cut) { return static_cast<int>(cut.disk.border.size()); }

/// Offset of a border edge from the first edge of a path, in edges along the border.
int place_in_path(const CutDisk& cut, int path, int border_index) {
  const int offset = border_index - cut.paths[path].first;
  return offset < 0 ? offset + border_size(cut) : offset;
}

/// Splits the triangle with the half-edge a -> b at a vertex m on that edge.
void split_triangle(DiskMesh& disk, int a, int b, int m) {
  for (std::size_t i = 0; i < disk.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      Triangle& t = disk.triangles[i];
      if (t[k] != a || t[(k + 1) % 3] != b) continue;
      const Triangle rest{m, b, t[(k + 2) % 3]};
      t[(k + 1) % 3] = m;
      disk.triangles.push_back(rest);
      if (!disk.surface_triangle.empty()) disk.surface_triangle.push_back(disk.surface_triangle[i]);
      return;
    }
  WEFT_ASSERT(false && "a border edge has a triangle");
}

/// The surface point shared by the two vertices that split an edge and its mate.
struct SplitPoint {
  Vec3d position;
  int surface_vertex;
};

/// Splits one border edge; its mate is not changed.
void insert_vertex(CutDisk& cut, int border_index, double fraction, SplitPoint point) {
  const int path = path_of_border_edge(cut, border_index);
  DiskMesh& disk = cut.disk;
  const int a = disk.border[border_index];
  const int b = disk.border[(border_index + 1) % border_size(cut)];
  const int m = add_split_vertex(disk, {a, b, fraction}, point.position, point.surface_vertex);
  split_triangle(disk, a, b, m);
  disk.border.insert(disk.border.begin() + border_index + 1, m);
  ++cut.paths[path].edges;
  for (BorderPath& other : cut.paths)
    if (other.first > border_index) ++other.first;
}

}  // namespace

int path_of_border_edge(const CutDisk& cut, int border_index) {
  const int count = static_cast<int>(cut.paths.size());
  for (int p = 0; p < count; ++p)
    if (place_in_path(cut, p, border_index) < cut.paths[p].edges) return p;
  WEFT_ASSERT(false && "the paths cover the border");
  return -1;
}

void split_border_edge(CutDisk& cut, int border_index, double fraction) {
  const DiskMesh& disk = cut.disk;
  const int path = path_of_border_edge(cut, border_index);
  const int place = place_in_path(cut, path, border_index);
  const int edges = cut.paths[path].edges;
  const Vec3d a = disk.positions[disk.border[border_index]];
  const Vec3d b = disk.positions[disk.border[(border_index + 1) % border_size(cut)]];
  const SplitPoint point{
      a + fraction * (b - a),
      *std::max_element(disk.surface_vertex.begin(), disk.surface_vertex.end()) + 1};
  insert_vertex(cut, border_index, fraction, point);
  const int mate = cut.paths[path].mate;
  if (mate < 0) return;
  const int mate_index = (cut.paths[mate].first + edges - 1 - place) % border_size(cut);
  insert_vertex(cut, mate_index, 1 - fraction, point);
}

}  // namespace weft
