#pragma once

#include <functional>
#include <numbers>
#include <vector>

#include "weft/core/math.h"
#include "weft/core/orientation.h"
#include "weft/core/random.h"
#include "weft/geometry_image.h"
#include "weft/param/square_map.h"

/// Mapped disks made by hand: a grid of m x m vertices laid evenly over the square of n x n
/// samples.
namespace weft::maps {

using Surface = std::function<Vec3d(double u, double v)>;  ///< u, v in [0, 1]
using Join = std::function<int(int row, int col)>;         ///< the surface point of a grid vertex

inline MappedDisk grid(int n, int m, const Surface& surface, const Join& join) {
  MappedDisk mapped;
  mapped.map.size = mapped.layout.size = n;
  DiskMesh& disk = mapped.cut.disk;
  const auto place = [&](int k) { return k == m - 1 ? n - 1.0 : k * (n - 1.0) / (m - 1.0); };
  for (int row = 0; row < m; ++row)
    for (int col = 0; col < m; ++col) {
      mapped.map.uv.push_back({place(col), place(row)});
      const int point = join(row, col);
      disk.positions.push_back(surface(point % m / (m - 1.0), point / m / (m - 1.0)));
      disk.surface_vertex.push_back(point);
    }
  for (int row = 0; row + 1 < m; ++row)
    for (int col = 0; col + 1 < m; ++col) {
      const int a = row * m + col;
      disk.triangles.push_back({a, a + 1, a + m + 1});
      disk.triangles.push_back({a, a + m + 1, a + m});
    }
  for (int t = 0; t < 4 * (m - 1); ++t) disk.border.push_back(border_sample(m, t));
  return mapped;
}

inline void add_path(MappedDisk& mapped, int edges, int intervals, int mate) {
  const bool first = mapped.cut.paths.empty();
  const int edge = first ? 0 : mapped.cut.paths.back().first + mapped.cut.paths.back().edges;
  const int position = first ? 0 : mapped.layout.first.back() + mapped.layout.intervals.back();
  mapped.cut.paths.push_back({edge, edges, mate, mate < 0 ? 0 : -1});
  mapped.layout.first.push_back(position);
  mapped.layout.intervals.push_back(intervals);
}

/// A surface with one border, that of the square.
inline MappedDisk sheet(int n, int m, const Surface& surface) {
  MappedDisk mapped = grid(n, m, surface, [m](int row, int col) { return row * m + col; });
  add_path(mapped, 4 * (m - 1), 4 * (n - 1), -1);
  return mapped;
}

inline Vec3d flat(double u, double v) { return {u, 0, -v}; }

inline Vec3d torus_point(double u, double v) {
  const double ring = 1 + 0.4 * cosine(2 * pi * v);
  return {ring * cosine(2 * pi * u), 0.4 * sine(2 * pi * v), -ring * sine(2 * pi * u)};
}

/// A torus cut along two circles.
inline MappedDisk torus(int n, int m) {
  MappedDisk mapped =
      grid(n, m, torus_point, [m](int row, int col) { return row % (m - 1) * m + col % (m - 1); });
  for (const int mate : {2, 3, 0, 1}) add_path(mapped, m - 1, n - 1, mate);
  return mapped;
}

/// A closed pillow cut from one tip to the other: the tips are two opposite corners of the square.
inline MappedDisk pillow(int n, int m) {
  const auto bulge = [](double u, double v) -> Vec3d {
    return {u + v, 4 * (u - v) * (u - v), (u - v) * (1 + u * v) * u * v * (1 - u) * (1 - v)};
  };
  MappedDisk mapped = grid(n, m, bulge, [m](int row, int col) {
    const bool on_border = row == 0 || col == 0 || row == m - 1 || col == m - 1;
    return on_border ? std::min(row, col) * m + std::max(row, col) : row * m + col;
  });
  for (const int mate : {1, 0}) add_path(mapped, 2 * (m - 1), 2 * (n - 1), mate);
  return mapped;
}

/// Moves interior vertices at random, far enough to make slivers, every triangle staying turned
/// left.
inline void shake(MappedDisk& mapped, std::uint64_t seed) {
  const DiskMesh& disk = mapped.cut.disk;
  std::vector<std::vector<int>> around(disk.positions.size());
  std::vector<bool> fixed(disk.positions.size(), false);
  for (const int vertex : disk.border) fixed[vertex] = true;
  for (int t = 0; t < static_cast<int>(disk.triangles.size()); ++t)
    for (const int vertex : disk.triangles[t]) around[vertex].push_back(t);
  std::vector<Vec2d>& uv = mapped.map.uv;
  const auto valid = [&](int vertex) {
    for (const int t : around[vertex]) {
      const Triangle& corners = disk.triangles[t];
      if (orientation(uv[corners[0]], uv[corners[1]], uv[corners[2]]) <= 0) return false;
    }
    return true;
  };
  Random random(seed);
  for (int round = 0; round < 4; ++round)
    for (int vertex = 0; vertex < static_cast<int>(uv.size()); ++vertex) {
      if (fixed[vertex]) continue;
      const Vec2d old = uv[vertex];
      const Triangle& t = disk.triangles[around[vertex][random.index(6)]];
      // Almost, or by the last bit, onto the middle of a triangle's side.
      const Vec2d goal = 0.5 * (uv[t[random.index(3)]] + uv[t[random.index(3)]]);
      const double rest = random.index(2) == 0 ? 1e-13 : 0.2 * random.uniform();
      uv[vertex] = goal + rest * (old - goal);
      if (random.index(8) == 0) uv[vertex] = {std::floor(old.x), std::floor(old.y)};
      if (!valid(vertex)) uv[vertex] = old;
    }
}

}  // namespace weft::maps
