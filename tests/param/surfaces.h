#pragma once

#include "weft/core/math.h"
#include "weft/mesh/triangle_mesh.h"

namespace weft::test {

/// A torus of radii 1 and 0.35, `around` x `across` quads of two triangles.
inline TriangleMesh torus(int around, int across) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = 2 * pi * i / around;
      const double b = 2 * pi * j / across;
      const double r = 1 + 0.35 * cosine(b);
      mesh.positions.push_back({r * cosine(a), 0.35 * sine(b), -r * sine(a)});
    }
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const int next_i = (i + 1) % around;
      const int next_j = (j + 1) % across;
      const int p = i * across + j;
      const int q = next_i * across + j;
      const int r = next_i * across + next_j;
      const int s = i * across + next_j;
      mesh.triangles.insert(mesh.triangles.end(), {{p, q, r}, {p, r, s}});
    }
  return mesh;
}

/// A tube of radius 0.2 and length 2, open below and closed above by a fan: `around` x `along`
/// quads. One border loop; its last vertex is the tip.
inline TriangleMesh sock(int around, int along) {
  TriangleMesh mesh;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * pi * i / around;
      mesh.positions.push_back({0.2 * cosine(a), 2.0 * j / along, -0.2 * sine(a)});
    }
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int p = j * around + i;
      const int q = j * around + (i + 1) % around;
      mesh.triangles.insert(mesh.triangles.end(),
                            {{p, q, q + around}, {p, q + around, p + around}});
    }
  const int tip = static_cast<int>(mesh.positions.size());
  mesh.positions.push_back({0, 2.05, 0});
  for (int i = 0; i < around; ++i)
    mesh.triangles.push_back({along * around + i, along * around + (i + 1) % around, tip});
  return mesh;
}

}  // namespace weft::test
