#pragma once

#include <cmath>
#include <string>

#include "weft/core/error.h"
#include "weft/core/math.h"
#include "weft/mesh/triangle_mesh.h"

namespace weft::testing {

/// Corners of a tetrahedron, faces outward.
inline TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

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

/// A torus of rows x cols quads around the y axis, faces outward.
inline TriangleMesh torus(int rows, int cols) {
  TriangleMesh mesh;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < cols; ++c) {
      const double around = 2 * pi * c / cols, tube = 2 * pi * r / rows;
      const double radius = 2 + cosine(tube);
      mesh.positions.push_back({radius * cosine(around), sine(tube), radius * sine(around)});
    }
  const auto at = [&](int r, int c) { return (r % rows) * cols + c % cols; };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < cols; ++c) {
      mesh.triangles.push_back({at(r, c), at(r + 1, c), at(r + 1, c + 1)});
      mesh.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r, c + 1)});
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

/// Six times the volume inside a closed mesh, positive when its faces look outward.
inline double signed_volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += dot(mesh.positions[t[0]], cross(mesh.positions[t[1]], mesh.positions[t[2]]));
  return sum;
}

/// What an error of the wanted kind says; empty when there is none.
template <class Wanted, class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Wanted& error) {
    return error.what();
  }
  return {};
}

}  // namespace weft::testing
