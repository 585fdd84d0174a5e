#include "weft/collide/filter/safe_positions.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// 1 up to `near`, 0 from `far` on, smooth between.
double fading(double distance, double near, double far) {
  const double t = std::clamp((far - distance) / (far - near), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Mean of shifts, the nearer things counting more.
class Shift {
 public:
  /// @param reach  where it begins to count [m]
  void add(double distance, double reach, Vec3d shift) {
    if (distance >= reach) return;
    constexpr double nearest = 1e-5;  // lest it be infinite [m]
    const double closeness = 1 / (nearest + distance) - 1 / (nearest + reach);
    const double weight = closeness * closeness;
    sum_ += weight * shift;
    weights_ += weight;
  }
  [[nodiscard]] Vec3d mean() const { return weights_ > 0 ? (1 / weights_) * sum_ : Vec3d{}; }

 private:
  Vec3d sum_;
  double weights_ = 0;
};

}  // namespace

Vec3d SafePositions::Carrier::displacement(Vec3d start, const BodyPoint& at, bool slides) const {
  if (stands()) return {};
  const Vec3d whole = rigid ? (*rigid)(start)-start : displacement_of(*body, at);
  const Vec3d across = normalized(start - at.position);
  return slides ? dot(whole, across) * across : whole;
}

Vec3d SafePositions::shift_at(Vec3d start, const SafePositionSurroundings& around) const {
  Shift shift;
  for (const Carrier& carrier : carriers_) {
    const double reach = carrier.stands() ? around.held : around.reached;
    const auto found = carrier.body->query->closest(start, reach);
    if (!found) continue;
    const double distance = std::sqrt(found->squared_distance);
    const Vec3d displacement = carrier.displacement(start, *found, around.slides);
    shift.add(distance, reach, fading(distance, around.carried, reach) * displacement);
  }
  if (around.ground != nullptr)
    shift.add(std::abs(start.y - around.ground->height), around.held, {});
  return shift.mean();
}

void SafePositions::find(const Planes3& start, const SafePositionSurroundings& surroundings,
                         Planes3& safe_position, ThreadTeam& team) {
  carriers_.clear();
  for (const ContactBody& body : surroundings.bodies)
    carriers_.push_back(
        {&body, body.start == body.end ? std::nullopt : rigid_motion(*body.start, *body.end)});
  const int count = start.size() * start.size();
  team.run([&](Worker& worker) {
    const Range mine = worker.share(count);
    for (int s = mine.first; s < mine.last; ++s) {
      const Vec3d at = vec_cast<double>(start.at(s));
      safe_position.set(s, vec_cast<float>(at + shift_at(at, surroundings)));
    }
  });
}

}  // namespace weft
