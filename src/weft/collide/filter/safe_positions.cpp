#include "weft/collide/filter/safe_positions.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Rounding of single precision, relative to the size of positions, generously.
constexpr double close_enough = 1e-6;

/// A distance that avoids divisions by none [m].
constexpr double smallest_reach = 1e-9;

/// The sample with the largest measure, the first of several.
template <class Measure>
int largest(int count, const Measure& measure) {
  int best = 0;
  double max = -HUGE_VAL;
  for (int s = 0; s < count; ++s)
    if (const double found = measure(s); found > max) {
      max = found;
      best = s;
    }
  return best;
}

/// Orthonormal frame of three samples: towards the second, in their plane, normal to it.
std::array<Vec3d, 3> frame(const Planes3& at, const std::array<int, 3>& samples) {
  const auto p = [&](std::size_t k) { return vec_cast<double>(at.at(samples[k])); };
  const Vec3d along = normalized(p(1) - p(0));
  const Vec3d across = normalized(cross(along, p(2) - p(0)));
  return {along, cross(across, along), across};
}

std::array<int, 3> far_apart(const Planes3& at) {
  const int count = at.size() * at.size();
  const auto p = [&](int s) { return vec_cast<double>(at.at(s)); };
  const int second = largest(count, [&](int s) { return squared_length(p(s) - p(0)); });
  const Vec3d along = p(second) - p(0);
  const int third =
      largest(count, [&](int s) { return squared_length(cross(along, p(s) - p(0))); });
  return {0, second, third};
}

}  // namespace

std::optional<RigidMotion> rigid_motion(const Planes3& start, const Planes3& end) {
  const std::array<int, 3> samples = far_apart(start);
  const std::array<Vec3d, 3> from = frame(start, samples), to = frame(end, samples);
  RigidMotion motion;
  const auto row = [&](double Vec3d::*part) {
    return to[0].*part * from[0] + to[1].*part * from[1] + to[2].*part * from[2];
  };
  motion.rows = {row(&Vec3d::x), row(&Vec3d::y), row(&Vec3d::z)};
  const Vec3d first = vec_cast<double>(start.at(samples[0]));
  motion.shift = vec_cast<double>(end.at(samples[0])) - motion(first);
  for (int s = 0; s < start.size() * start.size(); ++s) {
    const Vec3d wanted = vec_cast<double>(end.at(s));
    const double off = length(motion(vec_cast<double>(start.at(s))) - wanted);
    if (!(off <= close_enough * (1 + length(wanted)))) return std::nullopt;
  }
  return motion;
}
namespace {

/// 1 up to `near`, 0 from `far` on, smooth between.
double fading(double distance, double near, double far) {
  const double t = std::clamp((far - distance) / (far - near), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Weighted mean of the shifts of nearby obstacles; nearer ones count more.
class Shift {
 public:
  /// @param reach  distance from which on it does not count [m]
  void add(double distance, double reach, Vec3d shift) {
    if (distance >= reach) return;
    constexpr double nearest = 1e-5;  // keeps the weight finite [m]
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

/// Distance of a point to the nearest obstacle, or `reach` where none is nearer. [m]
double distance_within(double reach, Vec3d at, const SafePositionSurroundings& obstacles) {
  double nearest = reach;
  if (obstacles.ground != nullptr)
    nearest = std::min(nearest, std::abs(at.y - obstacles.ground->height));
  for (const ContactBody& body : obstacles.bodies)
    if (const auto found = body.query->closest(at, nearest))
      nearest = std::min(nearest, std::sqrt(found->squared_distance));
  return nearest;
}

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

void SafePositions::find_along(const Planes3& start, const SafePositionSurroundings& obstacles,
                               Vec3d translation, Planes3& safe_position, ThreadTeam& team) {
  const double reach = std::max(smallest_reach, length(translation) / max_part_of_distance);
  team.run([&](Worker& worker) {
    const Range mine = worker.share(start.size() * start.size());
    for (int s = mine.first; s < mine.last; ++s) {
      const Vec3d at = vec_cast<double>(start.at(s));
      const double part = distance_within(reach, at, obstacles) / reach;
      safe_position.set(s, vec_cast<float>(at + part * translation));
    }
  });
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
