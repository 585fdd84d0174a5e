#pragma once

#include "weft/core/math.h"
#include "weft/drawing.h"
#include "weft/grid.h"

namespace weft {

/// A sphere as a grid: u around, v from the south pole up; normals outward.
inline Planes3 sphere_grid(int n, Vec3f centre, float radius) {
  Planes3 grid(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double v = pi * r / (n - 1);
      const double u = 2 * pi * c / (n - 1);
      const Vec3d d{sine(v) * sine(u), -cosine(v), sine(v) * cosine(u)};
      grid.set(r, c, centre + radius * vec_cast<float>(d));
    }
  return grid;
}

/// A sheet of side 2 in the xz plane that rises and falls in waves.
inline Planes3 wavy_sheet(int n, float height) {
  Planes3 grid(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double x = 2.0 * c / (n - 1) - 1;
      const double z = 2.0 * r / (n - 1) - 1;
      const double wave = 0.12 * sine(5 * x + 2 * z) + 0.05 * sine(9 * z - 3 * x);
      grid.set(r, c, vec_cast<float>(Vec3d{x, height + wave, z}));
    }
  return grid;
}

/// A cube of side 1 around the origin.
inline TriangleMesh cube_mesh() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({(i & 1) - 0.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) - 0.5});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

}  // namespace weft
