#include "weft/sim/motion/grab.h"

#include <algorithm>

#include "weft/cloth/cloth.h"
#include "weft/simulation.h"

namespace weft {
namespace {

/// Largest speed of the grabbed point [m/s].
constexpr double max_speed = 3;
/// Largest distance from the neighbouring samples, in rest lengths: the strain limit lets cloth
/// stretch a little.
constexpr double max_stretch = 1.08;

/// Moves a towards b, by at most `most`.
Vec3d towards(Vec3d a, Vec3d b, double most) {
  const double distance = length(b - a);
  return distance > most ? a + (most / distance) * (b - a) : b;
}

/// Next position of a pin, limited so that it overstretches no spring to the neighbours of its
/// copies. Neighbours are extrapolated by their velocity along the displacement; so the pin gives
/// way no more than it must where the cloth is taut and springs back.
/// @param displacement  of the pin in the step [m]
Vec3d within_reach(const SimulatedCloth& held, const Pin& pin, double time_step,
                   Vec3d displacement) {
  const int n = held.model->size;
  Vec3d place = vec_cast<double>(held.state.position.at(pin.sample)) + displacement;
  const Vec3d ahead = normalized(displacement);
  const auto beside = [&](int copy, int down, int right) {
    const int r = copy / n + down, c = copy % n + right;
    if (std::min(r, c) < 0 || std::max(r, c) >= n) return;
    if (!held.model->mates.same_chart(copy, r * n + c)) return;
    const Vec3d rest = vec_cast<double>(held.model->rest.at(r, c) - held.model->rest.at(copy));
    const double along = dot(vec_cast<double>(held.state.velocity.at(r, c)), ahead);
    const Vec3d there = vec_cast<double>(held.state.position.at(r, c)) +
                        std::min(std::max(0.0, along) * time_step, length(displacement)) * ahead;
    place = towards(there, place, max_stretch * length(rest));
  };
  for (const int copy : pin.copies) {
    beside(copy, -1, 0);
    beside(copy, 1, 0);
    beside(copy, 0, -1);
    beside(copy, 0, 1);
  }
  return place;
}

}  // namespace

void Grab::take(std::size_t cloth, int sample, SimulatedCloth& held) {
  const std::size_t pins = held.model->pins.size();
  const Vec3d here = vec_cast<double>(held.state.position.at(sample));
  pin_ = pin(*held.model, sample, here);
  added_ = held.model->pins.size() > pins;
  cloth_ = cloth;
  wanted_ = here;
}

void Grab::move(double time_step, std::optional<double> ground, SimulatedCloth& held) const {
  Pin& pin = held.model->pins[static_cast<std::size_t>(pin_)];
  const Vec3d here = vec_cast<double>(held.state.position.at(pin.sample));
  const Vec3d displacement = towards(here, wanted_, max_speed * time_step) - here;
  Vec3d next = within_reach(held, pin, time_step, displacement);
  const double thickness = held.model->material.thickness;
  if (ground) next.y = std::max(next.y, std::min(here.y, *ground + thickness));
  pin.target = next;
}

void Grab::let_go(Cloth& held) {
  if (added_) unpin_last(held);
  pin_ = -1;
}

}  // namespace weft
