#include "weft/param/chords.h"

#include <algorithm>
#include <array>

#include "weft/mesh/topology.h"

namespace weft {
namespace {

std::vector<bool> on_border(const DiskMesh& disk) {
  std::vector<bool> result(disk.positions.size(), false);
  for (const int v : disk.border) result[v] = true;
  return result;
}

int add_midpoint(DiskMesh& disk, int a, int b, int surface_id) {
  const Vec3d middle = 0.5 * (disk.positions[a] + disk.positions[b]);
  return add_split_vertex(disk, {a, b, 0.5}, middle, surface_id);
}

/// Subdivides a triangle at the midpoints of its sides; -1 where a side is not split.
void split_triangle(Triangle t, std::array<int, 3> middle, std::vector<Triangle>& out) {
  const auto count = std::count_if(middle.begin(), middle.end(), [](int m) { return m >= 0; });
  if (count == 0) {
    out.push_back(t);
    return;
  }
  // Rotated until side 0 is split, and of two split sides side 1 as well, so that one pattern
  // serves each count.
  while (middle[0] < 0 || (count == 2 && middle[1] < 0)) {
    std::rotate(t.begin(), t.begin() + 1, t.end());
    std::rotate(middle.begin(), middle.begin() + 1, middle.end());
  }
  const auto [a, b, c] = t;
  const auto [ab, bc, ca] = middle;
  if (count == 1) {
    out.insert(out.end(), {{a, ab, c}, {ab, b, c}});
  } else if (count == 2) {
    out.insert(out.end(), {{ab, b, bc}, {a, ab, bc}, {a, bc, c}});
  } else {
    out.insert(out.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
}

}  // namespace

int split_chords(DiskMesh& disk) {
  const std::vector<bool> border = on_border(disk);
  const HalfEdges edges = half_edges(static_cast<int>(disk.positions.size()), disk.triangles);
  const int count = static_cast<int>(edges.twin.size());
  int next_id = 0;
  for (const int id : disk.surface_vertex) next_id = std::max(next_id, id + 1);

  std::vector<int> middle(count, -1);
  int splits = 0;
  for (int h = 0; h < count; ++h) {
    const int twin = edges.twin[h];
    const int a = from_vertex(disk.triangles, h);
    const int b = to_vertex(disk.triangles, h);
    if (twin < h || !border[a] || !border[b]) continue;
    middle[h] = middle[twin] = add_midpoint(disk, a, b, next_id++);
    ++splits;
  }
  if (splits == 0) return 0;

  std::vector<Triangle> triangles;
  std::vector<int> surface_triangle;
  for (int t = 0; t < count / 3; ++t) {
    split_triangle(disk.triangles[t], {middle[3 * t], middle[3 * t + 1], middle[3 * t + 2]},
                   triangles);
    if (!disk.surface_triangle.empty())
      surface_triangle.resize(triangles.size(), disk.surface_triangle[t]);
  }
  disk.triangles = std::move(triangles);
  disk.surface_triangle = std::move(surface_triangle);
  return splits;
}

}  // namespace weft
