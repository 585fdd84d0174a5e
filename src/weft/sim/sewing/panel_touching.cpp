#include "weft/sim/sewing/panel_touching.h"

#include <algorithm>
#include <vector>

namespace weft {
namespace {

/// Distance below which two borders touch. [m]
constexpr double touching = 0.001;

/// The border of a panel.
struct Outline {
  Outline(const BorderMates& mates, int chart, const Planes3& placed)
      : sewn(mates), first(mates.first_position(chart)) {
    for (int b = first; b < mates.first_position(chart + 1); ++b) {
      points.push_back(vec_cast<double>(placed.at(mates.sample_at(b))));
      box.add(points.back());
    }
  }
  /// The class that the point with this number is sewn to.
  [[nodiscard]] int class_of(std::size_t i) const {
    return sewn.representative(sewn.sample_at(first + static_cast<int>(i)));
  }

  const BorderMates& sewn;
  int first;
  std::vector<Vec3d> points;
  Box3d box;
};

bool near(Vec3d p, const Box3d& box) {
  return length(p - max(box.lower, min(p, box.upper))) < touching;
}

double distance_to_segment(Vec3d p, Vec3d a, Vec3d b) {
  const Vec3d along = b - a;
  const double t = dot(p - a, along) / std::max(1e-30, dot(along, along));
  return length(a + std::clamp(t, 0.0, 1.0) * along - p);
}

/// Whether a point of the first touches the second elsewhere than where they are sewn together.
bool touches(const Outline& first, const Outline& second) {
  for (std::size_t i = 0; i < first.points.size(); ++i) {
    if (!near(first.points[i], second.box)) continue;
    for (std::size_t k = 0; k < second.points.size(); ++k) {
      const std::size_t next = (k + 1) % second.points.size();
      const int mine = first.class_of(i);
      if (mine == second.class_of(k) || mine == second.class_of(next)) continue;
      if (distance_to_segment(first.points[i], second.points[k], second.points[next]) < touching)
        return true;
    }
  }
  return false;
}

}  // namespace

bool panels_touch(const BorderMates& sewn, int a, int b, const Planes3& placed) {
  const Outline first(sewn, a, placed), second(sewn, b, placed);
  return touches(first, second) || touches(second, first);
}

}  // namespace weft
