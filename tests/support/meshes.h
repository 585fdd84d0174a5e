#pragma once

#include "weft/core/math.h"
#include "weft/mesh.h"
#include "weft/mesh/topology.h"

namespace weft::test {

/// Corners of a tetrahedron, faces outward.
inline TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// A torus about the y axis, faces outward: `around` x `across` quads of two triangles, vertex
/// i * across + j.
inline TriangleMesh torus(int around, int across, double major = 1, double minor = 0.35) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = 2 * pi * i / around, b = 2 * pi * j / across;
      const double r = major + minor * cosine(b);
      mesh.positions.push_back({r * cosine(a), minor * sine(b), -r * sine(a)});
    }
  const auto at = [&](int i, int j) { return i % around * across + j % across; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

inline TopologyCounts topology_of(const TriangleMesh& mesh) {
  return count_topology(static_cast<int>(mesh.positions.size()), mesh.triangles);
}

inline double area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * length(cross(mesh.positions[b] - mesh.positions[a],
                               mesh.positions[c] - mesh.positions[a]));
  return area;
}

/// The volume inside a closed mesh, positive when its faces look outward.
inline double volume_of(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += dot(mesh.positions[a], cross(mesh.positions[b], mesh.positions[c])) / 6;
  return volume;
}

}  // namespace weft::test
