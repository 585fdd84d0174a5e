#pragma once

#include <array>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "weft/mesh.h"

namespace weft::test {

/// The surface of a flat slab of unit cubes, one for every '#' in `rows`; other characters are
/// gaps, so a gap inside is a handle. A cube marked 'o' has no top face: a hole in the surface.
/// Cubes must not touch along an edge alone. Every face is two triangles; `stretch` scales x so
/// that lengths differ.
inline TriangleMesh slab_surface(const std::vector<std::string_view>& rows, double stretch = 1) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, int> names;
  const auto vertex = [&](std::array<int, 3> p) {
    const auto [place, fresh] = names.try_emplace(p, static_cast<int>(mesh.positions.size()));
    if (fresh) mesh.positions.push_back({stretch * p[0], 1.0 * p[1], 1.0 * p[2]});
    return place->second;
  };
  const auto solid = [&](int x, int y) {
    if (y < 0 || y >= static_cast<int>(rows.size()) || x < 0) return false;
    if (x >= static_cast<int>(rows[y].size())) return false;
    return rows[y][x] == '#' || rows[y][x] == 'o';
  };
  const auto face = [&](std::array<int, 3> p, std::array<int, 3> u, std::array<int, 3> v) {
    const auto at = [&](int i, int j) {
      return vertex(
          {p[0] + i * u[0] + j * v[0], p[1] + i * u[1] + j * v[1], p[2] + i * u[2] + j * v[2]});
    };
    mesh.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
    mesh.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
  };
  const std::array<int, 3> ex{1, 0, 0}, ey{0, 1, 0}, ez{0, 0, 1};
  for (int y = 0; y < static_cast<int>(rows.size()); ++y)
    for (int x = 0; x < static_cast<int>(rows[y].size()); ++x) {
      if (!solid(x, y)) continue;
      if (rows[y][x] != 'o') face({x, y, 1}, ex, ey);
      face({x, y, 0}, ey, ex);
      if (!solid(x - 1, y)) face({x, y, 0}, ez, ey);
      if (!solid(x + 1, y)) face({x + 1, y, 0}, ey, ez);
      if (!solid(x, y - 1)) face({x, y, 0}, ex, ez);
      if (!solid(x, y + 1)) face({x, y + 1, 0}, ez, ex);
    }
  return mesh;
}

}  // namespace weft::test
