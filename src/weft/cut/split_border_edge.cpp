#include "weft/cut/split_border_edge.h"

#include <algorithm>

#include "weft/core/assert.h"

namespace weft {
namespace {

int border_size(const CutDisk& cut) { return static_cast<int>(cut.disk.border.size()); }

/// How many edges after the path's first the border edge comes.
int place_in_path(const CutDisk& cut, int path, int border_index) {
  const int offset = border_index - cut.paths[path].first;
  return offset < 0 ? offset + border_size(cut) : offset;
}

/// Splits the triangle that has the half-edge a -> b at the vertex m between them.
void split_triangle(std::vector<Triangle>& triangles, int a, int b, int m) {
  for (Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      if (t[k] != a || t[(k + 1) % 3] != b) continue;
      const Triangle rest{m, b, t[(k + 2) % 3]};
      t[(k + 1) % 3] = m;
      triangles.push_back(rest);
      return;
    }
  WEFT_ASSERT(false && "a border edge has a triangle");
}

/// Puts a vertex into one border edge, its mate left alone.
void insert_vertex(CutDisk& cut, int border_index, Vec3d position, int surface_vertex) {
  const int path = path_of_border_edge(cut, border_index);
  DiskMesh& disk = cut.disk;
  const int a = disk.border[border_index];
  const int b = disk.border[(border_index + 1) % border_size(cut)];
  const int m = static_cast<int>(disk.positions.size());
  disk.positions.push_back(position);
  disk.surface_vertex.push_back(surface_vertex);
  split_triangle(disk.triangles, a, b, m);
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
  const Vec3d middle = a + fraction * (b - a);
  const int fresh = *std::max_element(disk.surface_vertex.begin(), disk.surface_vertex.end()) + 1;
  insert_vertex(cut, border_index, middle, fresh);
  const int mate = cut.paths[path].mate;
  if (mate < 0) return;
  const int mate_index = (cut.paths[mate].first + edges - 1 - place) % border_size(cut);
  insert_vertex(cut, mate_index, middle, fresh);
}

}  // namespace weft
