#pragma once

#include "weft/core/math.h"
#include "weft/mesh.h"

namespace weft::test {

/// A strip of `count` quads that closes to a ring, flat in its indices only: `twisted` joins the
/// ends crosswise and makes a Moebius strip.
inline TriangleMesh ring(int count, bool twisted) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    for (const double height : {0.0, 1.0})
      mesh.positions.push_back({cosine(angle), height, sine(angle)});
  }
  for (int i = 0; i < count; ++i) {
    const bool cross = twisted && i + 1 == count;
    const int low = 2 * ((i + 1) % count) + (cross ? 1 : 0);
    const int high = 2 * ((i + 1) % count) + (cross ? 0 : 1);
    mesh.triangles.push_back({2 * i, 2 * i + 1, low});
    mesh.triangles.push_back({2 * i + 1, high, low});
  }
  return mesh;
}

/// Both meshes side by side in one value, untouched.
inline TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const int shift = static_cast<int>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const Triangle& t : b.triangles)
    a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return a;
}

}  // namespace weft::test
