#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/cloth/sheets.h"
#include "weft/cloth/bending.h"
#include "weft/cloth/mates.h"

/// Flat shapes whose bending is known, and what bends them.
namespace weft::testing {

inline const Material stiff{.bending = 1e-3};
/// Nine times stiffer along the warp.
inline const Material stiff_warp{.bending = {1e-3, 1e-3 / 9}};

/// A flat square whose samples are unevenly spread and whose grid lines are not at right angles.
inline Planes3 uneven_sheet(int n) {
  Planes3 p(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double u = c / (n - 1.0), v = r / (n - 1.0);
      const double x = u + 0.06 * sine(2 * pi * u) + 0.05 * sine(pi * u) * sine(2 * pi * v);
      const double z = v - 0.05 * sine(pi * v) * sine(pi * (u + 0.3));
      p.set(r, c, vec_cast<float>(Vec3d{x - 0.5, 0, z - 0.5}));
    }
  return p;
}

/// A flat disk: the border of the image is a circle, its corners lie on it like all else.
inline Planes3 disk(int n) {
  Planes3 p(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double x = 2.0 * c / (n - 1) - 1, z = 2.0 * r / (n - 1) - 1;
      const double out = std::max(std::abs(x), std::abs(z)), round = std::sqrt(x * x + z * z);
      const double scale = round > 0 ? 0.5 * out / round : 0;
      p.set(r, c, vec_cast<float>(Vec3d{scale * x, 0, scale * z}));
    }
  return p;
}

inline Cloth flat_cloth(const Planes3& rest, const Material& material = stiff) {
  return make_cloth(rest, no_mates(rest.size()), material);
}

inline Planes3 mapped(const Planes3& from, const std::function<Vec3d(Vec3d)>& map) {
  Planes3 to(from.size());
  for (int s = 0; s < from.size() * from.size(); ++s)
    to.set(s, vec_cast<float>(map(vec_cast<double>(from.at(s)))));
  return to;
}

inline Vec3d turned(Vec3d p) {
  const Vec3d x = normalized(Vec3d{1, 2, -1}), y = normalized(cross(x, Vec3d{0, 1, 1}));
  return p.x * x + p.y * y + p.z * cross(x, y) + Vec3d{0.3, -0.2, 0.5};
}

/// Each particle's whole bending force, or what a change from rest makes of it.
inline Planes3 forces(const Cloth& cloth, const Planes3& position, bool change = false,
                      int threads = 1) {
  Planes3 out(cloth.size);
  BendingPass pass(cloth);
  ThreadTeam team(threads);
  team.run([&](Worker& worker) {
    pass.curve(change ? cloth.rest : position, worker);
    if (change) pass.curve_change(position, worker);
    const Range mine = worker.share(cloth.size);
    for (int r = mine.first; r < mine.last; ++r) pass.add_row(1, r, out);
    worker.barrier();
    sum_over_mates(cloth.mates, worker, {&out.x, &out.y, &out.z});
  });
  return out;
}

inline double largest(const Planes3& planes) {
  double max = 0;
  for (int s = 0; s < planes.size() * planes.size(); ++s)
    max = std::max(max, length(vec_cast<double>(planes.at(s))));
  return max;
}

inline double dot_product(const Cloth& cloth, const Planes3& a, const Planes3& b) {
  double sum = 0;
  for (int s = 0; s < cloth.size * cloth.size; ++s)
    sum += double{cloth.owner(s / cloth.size, s % cloth.size)} *
           dot(vec_cast<double>(a.at(s)), vec_cast<double>(b.at(s)));
  return sum;
}

/// What the forces make of moving particles by a micrometre, which rounding must stay below.
inline double force_of_a_hair(const Cloth& cloth) {
  Planes3 p(cloth.size);
  shake(cloth, 1e-6, p);
  return largest(forces(cloth, p, true));
}

}  // namespace weft::testing
