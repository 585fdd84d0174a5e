#include "weft/sim/motion/motion_path.h"

#include <algorithm>

#include "weft/core/math.h"

namespace weft {
namespace {

Vec3d between(double part, Vec3d a, Vec3d b) { return a + part * (b - a); }

}  // namespace

MotionKey key_at(std::span<const MotionKey> path, double seconds) {
  if (seconds <= path.front().time) return path.front();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const MotionKey &a = path[i - 1], &b = path[i];
    if (seconds > b.time) continue;
    const double part = (seconds - a.time) / (b.time - a.time);
    return {seconds, between(part, a.rotate, b.rotate), between(part, a.translate, b.translate)};
  }
  return path.back();
}

double fastest_on(std::span<const MotionKey> path, double reach) {
  double fastest = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const MotionKey &a = path[i - 1], &b = path[i];
    const double distance =
        length(b.translate - a.translate) + reach * pi / 180 * length(b.rotate - a.rotate);
    fastest = std::max(fastest, distance / (b.time - a.time));
  }
  return fastest;
}

}  // namespace weft
