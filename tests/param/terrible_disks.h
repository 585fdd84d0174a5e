#pragma once

#include "weft/core/math.h"
#include "weft/core/random.h"
#include "weft/cut/disk_mesh.h"

namespace weft::test {

/// Rings of `around` vertices one inside the other and a tip; ring 0 is the border. `place(ring,
/// angle)` gives the surface; ring `rings` is the tip.
template <class Place>
DiskMesh nested_rings(int around, int rings, const Place& place) {
  DiskMesh disk;
  for (int r = 0; r < rings; ++r)
    for (int k = 0; k < around; ++k)
      disk.positions.push_back(place(r, 2 * pi * (k + 0.5 * (r % 2)) / around));
  const int tip = static_cast<int>(disk.positions.size());
  disk.positions.push_back(place(rings, 0.0));
  for (int r = 0; r < rings; ++r)
    for (int k = 0; k < around; ++k) {
      const int next = (k + 1) % around;
      const int a = r * around + k;
      const int b = r * around + next;
      if (r + 1 == rings) {
        disk.triangles.push_back({a, b, tip});
        continue;
      }
      // Rings are turned by half a step against each other, to and fro.
      const int c = a + around;
      const int d = b + around;
      if (r % 2 == 0)
        disk.triangles.insert(disk.triangles.end(), {{a, b, c}, {b, d, c}});
      else
        disk.triangles.insert(disk.triangles.end(), {{a, d, c}, {a, b, d}});
    }
  for (int k = 0; k < around; ++k) disk.border.push_back(k);
  for (int v = 0; v <= tip; ++v) disk.surface_vertex.push_back(v);
  return disk;
}

/// A tube closed at its far end: a map squeezes each ring into the last.
inline DiskMesh long_neck(int around, int rings, double step) {
  return nested_rings(around, rings, [=](int ring, double angle) {
    return Vec3d{0.1 * cosine(angle), 0.1 * sine(angle), step * ring};
  });
}

/// Rings that shrink by one factor from each to the next.
inline DiskMesh shrinking_rings(int around, int rings, double factor) {
  return nested_rings(around, rings, [=](int ring, double angle) {
    double radius = 1;
    for (int k = 0; k < ring; ++k) radius *= factor;
    return Vec3d{radius * cosine(angle), radius * sine(angle), 0};
  });
}

/// A tip that `spokes` needles meet at, in a border that is as fine.
inline DiskMesh sliver_fan(int spokes, double length) {
  return nested_rings(spokes, 2, [=](int ring, double angle) {
    const double radius = ring == 0 ? length * 1.001 : ring == 1 ? length : 0;
    return Vec3d{radius * cosine(angle), radius * sine(angle), ring == 2 ? 1.0 : 0.0};
  });
}

/// A strip of squares, wound up where it lies: its vertices see each other only along it.
inline DiskMesh spiral(int cells) {
  DiskMesh disk;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c <= cells; ++c) {
      const double angle = 0.05 * c;
      const double radius = 0.1 + 0.01 * angle + 0.01 * r;
      disk.surface_vertex.push_back(static_cast<int>(disk.positions.size()));
      disk.positions.push_back({radius * cosine(angle), radius * sine(angle), 0});
    }
  const int side = cells + 1;
  for (int r = 0; r < 2; ++r)
    for (int c = 0; c < cells; ++c) {
      const int a = r * side + c;
      disk.triangles.insert(disk.triangles.end(),
                            {{a, a + 1, a + side}, {a + 1, a + side + 1, a + side}});
    }
  for (int c = 0; c < cells; ++c) disk.border.push_back(c);
  for (int r = 0; r < 2; ++r) disk.border.push_back(r * side + cells);
  for (int c = cells; c > 0; --c) disk.border.push_back(2 * side + c);
  for (int r = 2; r > 0; --r) disk.border.push_back(r * side);
  return disk;
}

/// The border spread evenly over the border of [0, extent]^2, a vertex in every corner.
inline std::vector<Vec2d> even_border(const DiskMesh& disk, double extent) {
  std::vector<Vec2d> uv(disk.positions.size());
  const int count = static_cast<int>(disk.border.size());
  for (int side = 0; side < 4; ++side) {
    const int first = side * count / 4;
    const int last = (side + 1) * count / 4;
    for (int b = first; b < last; ++b) {
      const double t = extent * (b - first) / (last - first);
      const Vec2d on_side[] = {{t, 0}, {extent, t}, {extent - t, extent}, {0, extent - t}};
      uv[disk.border[b]] = on_side[side];
    }
  }
  return uv;
}

}  // namespace weft::test
