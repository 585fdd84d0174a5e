#include "weft/collide/filter/impact.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Momentum balance of both sides at a common speed: momentum gained less momentum lost, and the
/// mass of the points that change speed.
struct Balance {
  double momentum = 0, mass = 0;
};

Balance balance_at(const ImpactSides& sides, double speed) {
  Balance balance;
  for (int k = 0; k < sides.count_a + sides.count_b; ++k) {
    const ImpactPoint& point = sides.points[k];
    const bool part = k < sides.count_a ? point.speed < speed : point.speed > speed;
    if (!part || point.inverse_mass <= 0) continue;
    balance.momentum += (speed - point.speed) / point.inverse_mass;
    balance.mass += 1 / point.inverse_mass;
  }
  return balance;
}

/// Common speed at which the balance vanishes. The balance grows with the speed and is linear
/// between the points' own speeds.
double free_speed(const ImpactSides& sides, double lowest, double highest) {
  double below = lowest, above = highest;
  for (int k = 0; k < sides.count_a + sides.count_b; ++k) {
    const double speed = sides.points[k].speed;
    if (!(speed > below && speed < above)) continue;
    (balance_at(sides, speed).momentum < 0 ? below : above) = speed;
  }
  const double middle = 0.5 * (below + above);
  const Balance balance = balance_at(sides, middle);
  return balance.mass > 0 ? middle - balance.momentum / balance.mass : middle;
}

}  // namespace

void strike(ImpactSides& sides) noexcept {
  double slowest = HUGE_VAL, fastest = sides.count_b > 0 ? -HUGE_VAL : sides.body_speed;
  // Held points of side a bound the common speed from above; those of side b, or a body, from
  // below.
  double held_a = HUGE_VAL, held_b = sides.count_b > 0 ? -HUGE_VAL : sides.body_speed;
  for (int k = 0; k < sides.count_a + sides.count_b; ++k) {
    const auto [speed, inverse_mass] = sides.points[k];
    if (k < sides.count_a) slowest = std::min(slowest, speed);
    if (k >= sides.count_a) fastest = std::max(fastest, speed);
    if (inverse_mass > 0) continue;
    if (k < sides.count_a) held_a = std::min(held_a, speed);
    if (k >= sides.count_a) held_b = std::max(held_b, speed);
  }
  if (!(slowest < fastest)) return;
  const double free = free_speed(sides, slowest, fastest);
  const double speed = held_b > held_a ? 0.5 * (held_a + held_b) : std::clamp(free, held_b, held_a);
  for (int k = 0; k < sides.count_a + sides.count_b; ++k) {
    ImpactPoint& point = sides.points[k];
    if (point.inverse_mass <= 0) continue;
    point.speed = k < sides.count_a ? std::max(point.speed, speed) : std::min(point.speed, speed);
  }
}

}  // namespace weft
