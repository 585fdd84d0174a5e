#include "weft/sim/placement.h"

#include "weft/core/math.h"

namespace weft {
namespace {

using Rows = std::array<Vec3d, 3>;

Rows multiplied(const Rows& a, const Rows& b) {
  Rows product;
  for (int i = 0; i < 3; ++i) product[i] = a[i].x * b[0] + a[i].y * b[1] + a[i].z * b[2];
  return product;
}

/// Rotation about x, then y, then z.
Rows rotation(Vec3d degrees) {
  const Vec3d angle = (pi / 180) * degrees;
  const double cx = cosine(angle.x), sx = sine(angle.x);
  const double cy = cosine(angle.y), sy = sine(angle.y);
  const double cz = cosine(angle.z), sz = sine(angle.z);
  const Rows about_x{{{1, 0, 0}, {0, cx, -sx}, {0, sx, cx}}};
  const Rows about_y{{{cy, 0, sy}, {0, 1, 0}, {-sy, 0, cy}}};
  const Rows about_z{{{cz, -sz, 0}, {sz, cz, 0}, {0, 0, 1}}};
  return multiplied(about_z, multiplied(about_y, about_x));
}

Rows diagonal(Vec3d d) { return {{{d.x, 0, 0}, {0, d.y, 0}, {0, 0, d.z}}}; }

}  // namespace

PlacementMap placement_map(const Placement& placement) {
  const Rows turn = rotation(placement.rotate);
  const Vec3d s = placement.scale;
  return {multiplied(turn, diagonal(s)), multiplied(turn, diagonal({1 / s.x, 1 / s.y, 1 / s.z})),
          placement.translate};
}

Planes3 placed_positions(const GeometryImage& image, const PlacementMap& map) {
  const int n = image.size();
  Planes3 positions(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      positions.set(r, c, vec_cast<float>(map.point(image.world_position(r, c))));
  return positions;
}

NormalMap placed_normals(const NormalMap& normals, const PlacementMap& map) {
  const int n = normals.size();
  NormalMap placed{Planes3(n)};
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      placed.normal.set(r, c,
                        vec_cast<float>(map.normal(vec_cast<double>(normals.normal.at(r, c)))));
  return placed;
}

Box3d box_of(const Planes3& positions) {
  Box3d box;
  const int n = positions.size();
  for (int s = 0; s < n * n; ++s) box.add(vec_cast<double>(positions.at(s)));
  return box;
}

}  // namespace weft
