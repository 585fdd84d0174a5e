#include "weft/collide/filter/rigid_motion.h"

#include <cmath>

namespace weft {
namespace {

/// Rounding of single precision, relative to the size of positions, generously.
constexpr double rounding = 1e-6;

/// The sample for which something is largest, the first of several.
template <class Measure>
int largest(int count, const Measure& measure) {
  int best = 0;
  double most = -HUGE_VAL;
  for (int s = 0; s < count; ++s)
    if (const double found = measure(s); found > most) {
      most = found;
      best = s;
    }
  return best;
}

/// Three axes by three samples: towards the second, in their plane, across it.
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
    if (!(off <= rounding * (1 + length(wanted)))) return std::nullopt;
  }
  return motion;
}

}  // namespace weft
