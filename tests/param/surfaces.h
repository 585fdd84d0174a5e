#pragma once

#include "weft/core/math.h"
#include "weft/mesh.h"

namespace weft::test {

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
