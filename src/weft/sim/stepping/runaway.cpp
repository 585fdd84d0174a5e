#include "weft/sim/stepping/runaway.h"

#include <algorithm>
#include <cmath>

#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

constexpr double generous = 100;
/// Energy per mass allowed even to a cloth without gravity and speed. [J/kg]
constexpr double min_energy = 0.5;

double squared_speed(const ClothState& state, int sample) {
  return squared_length(vec_cast<double>(state.velocity.at(sample)));
}

struct Motion {
  double kinetic = 0, mass = 0, fastest = 0;
  int fastest_sample = 0;
};

/// Sums and the largest squared speed over all samples. Every copy of a mate counts, which is
/// accurate enough for a bound.
Motion motion_of(const Cloth& cloth, const ClothState& state) {
  Motion motion;
  for (int s = 0; s < cloth.size * cloth.size; ++s) {
    const double mass = cloth.mass(s / cloth.size, s % cloth.size);
    const double squared = squared_speed(state, s);
    motion.mass += mass;
    motion.kinetic += 0.5 * mass * squared;
    if (squared > motion.fastest) {
      motion.fastest = squared;
      motion.fastest_sample = s;
    }
  }
  return motion;
}

}  // namespace

RunawayCheck::RunawayCheck(const Cloth& cloth, const ClothState& start, Vec3d gravity, double drive)
    : rows_(static_cast<std::size_t>(cloth.size)), gravity_(length(gravity)) {
  const Motion motion = motion_of(cloth, start);
  mass_ = motion.mass;
  // Cloth whose flat rest shape is of another size than its mesh begins strained.
  const double strained = potential_energy(cloth, start, {});
  start_energy_ = (motion.kinetic + strained) / motion.mass + 0.5 * drive * drive;
  speed_ = std::sqrt(motion.fastest) + drive;
  Box3d box;
  for (int s = 0; s < cloth.size * cloth.size; ++s) box.add(vec_cast<double>(start.position.at(s)));
  reach_ = box.diagonal();
}

double RunawayCheck::max_energy(double seconds) const {
  const double fallen = reach_ + speed_ * seconds + 0.5 * gravity_ * seconds * seconds;
  return generous * (min_energy + start_energy_ + gravity_ * fallen);
}

/// A single particle carries little of the total energy, so its speed is bounded separately.
bool RunawayCheck::suspect(const Cloth& cloth, const ClothState& state, double bound,
                           ThreadTeam& team) {
  const KernelTable& kernels = kernels_for(team.instructions());
  team.run([&](Worker& worker) {
    const Range mine = worker.share(cloth.size);
    for (int r = mine.first; r < mine.last; ++r)
      rows_[r] = kernels.motion(cloth.size, cloth.mass.row(r), row_of(state.position, r),
                                row_of(state.velocity, r));
  });
  double kinetic = 0;
  for (const RowMotion& row : rows_) {
    if (!row.finite || 0.5 * double{row.largest_squared} > generous * bound) return true;
    kinetic += row.kinetic;
  }
  return kinetic / mass_ > bound;
}

std::optional<BadParticle> RunawayCheck::find(const Cloth& cloth, const ClothState& state,
                                              double seconds, ThreadTeam& team) {
  if (!suspect(cloth, state, max_energy(seconds), team)) return std::nullopt;
  if (const auto bad = find_not_finite(state)) return bad;
  return fastest_particle(cloth, state);
}

BadParticle fastest_particle(const Cloth& cloth, const ClothState& state) {
  const int sample = motion_of(cloth, state).fastest_sample;
  return {sample / cloth.size, sample % cloth.size};
}

}  // namespace weft
