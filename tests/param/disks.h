#pragma once

#include <vector>

#include "weft/core/random.h"
#include "weft/cut/disk_mesh.h"

namespace weft::test {

/// A sheet of cells x cells squares, each cut into two triangles along a diagonal of random
/// direction
/// ("height" gives the surface over the unit square).
template <class Height>
DiskMesh sheet(int cells, const Height& height) {
  DiskMesh disk;
  Random random(7);
  const int side = cells + 1;
  for (int r = 0; r < side; ++r)
    for (int c = 0; c < side; ++c) {
      const double x = static_cast<double>(c) / cells;
      const double y = static_cast<double>(r) / cells;
      disk.positions.push_back({x, y, height(x, y)});
      disk.surface_vertex.push_back(r * side + c);
    }
  for (int r = 0; r < cells; ++r)
    for (int c = 0; c < cells; ++c) {
      const int a = r * side + c;
      const int b = a + 1;
      const int d = a + side;
      if (random.index(2) == 0) {
        disk.triangles.insert(disk.triangles.end(), {{a, b, d + 1}, {a, d + 1, d}});
      } else {
        disk.triangles.insert(disk.triangles.end(), {{a, b, d}, {b, d + 1, d}});
      }
    }
  for (int c = 0; c < cells; ++c) disk.border.push_back(c);
  for (int r = 0; r < cells; ++r) disk.border.push_back(r * side + cells);
  for (int c = cells; c > 0; --c) disk.border.push_back(cells * side + c);
  for (int r = cells; r > 0; --r) disk.border.push_back(r * side);
  return disk;
}

inline DiskMesh flat_sheet(int cells) {
  return sheet(cells, [](double, double) { return 0.0; });
}

/// The border of a sheet on the border of [0, extent]^2, everything else at the origin.
inline std::vector<Vec2d> square_border(const DiskMesh& sheet, double extent) {
  std::vector<Vec2d> uv(sheet.positions.size());
  for (const int v : sheet.border)
    uv[v] = {extent * sheet.positions[v].x, extent * sheet.positions[v].y};
  return uv;
}

/// The same disk with its vertices numbered at random.
inline DiskMesh shuffled(DiskMesh disk) {
  const int count = static_cast<int>(disk.positions.size());
  std::vector<int> number(count);
  for (int v = 0; v < count; ++v) number[v] = v;
  Random random(3);
  for (int v = count - 1; v > 0; --v) std::swap(number[v], number[random.index(v + 1)]);
  const DiskMesh before = disk;
  for (int v = 0; v < count; ++v) {
    disk.positions[number[v]] = before.positions[v];
    disk.surface_vertex[number[v]] = before.surface_vertex[v];
  }
  for (Triangle& t : disk.triangles)
    for (int& v : t) v = number[v];
  for (int& v : disk.border) v = number[v];
  return disk;
}

}  // namespace weft::test
