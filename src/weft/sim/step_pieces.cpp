#include "weft/sim/step_pieces.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Whether the box of a way and another overlap.
bool overlaps(const Box3d& a, const Box3d& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
         b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

}  // namespace

Box3d swept_box(const ClothState& cloth, double seconds, double padding) noexcept {
  Box3d box;
  const int n = cloth.position.size();
  for (int s = 0; s < n * n; ++s) {
    const Vec3d at = vec_cast<double>(cloth.position.at(s));
    box.add(at);
    box.add(at + seconds * vec_cast<double>(cloth.velocity.at(s)));
  }
  const Vec3d aside{padding, padding, padding};
  return {box.lower - aside, box.upper + aside};
}

double farthest_way(const Planes3& from, const Planes3& to) noexcept {
  float farthest = 0;
  for (int r = 0; r < from.size(); ++r) {
    const float *ax = from.x.row(r), *ay = from.y.row(r), *az = from.z.row(r);
    const float *bx = to.x.row(r), *by = to.y.row(r), *bz = to.z.row(r);
    for (int c = 0; c < from.size(); ++c) {
      const float x = bx[c] - ax[c], y = by[c] - ay[c], z = bz[c] - az[c];
      farthest = std::max(farthest, x * x + y * y + z * z);
    }
  }
  return std::sqrt(double{farthest});
}

double farthest_way(const Planes3& from, const Planes3& to, const Box3d& box) noexcept {
  double farthest = 0;
  for (int s = 0; s < from.size() * from.size(); ++s) {
    const Vec3d a = vec_cast<double>(from.at(s)), b = vec_cast<double>(to.at(s));
    const double squared = squared_length(b - a);
    if (squared <= farthest) continue;
    Box3d way;
    way.add(a);
    way.add(b);
    if (overlaps(way, box)) farthest = squared;
  }
  return std::sqrt(farthest);
}

int pieces_for(double way, double most) noexcept {
  int pieces = 1;
  while (pieces < most_pieces && way > pieces * most) pieces *= 2;
  return pieces;
}

}  // namespace weft
