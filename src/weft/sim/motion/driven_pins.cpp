#include "weft/sim/motion/driven_pins.h"

#include <algorithm>

namespace weft {
namespace {

/// How far a pin goes ahead of the free samples beside it in a step, in rest lengths.
double lead_of(const Pin& pin, const SimulatedCloth& cloth, double seconds) {
  const Cloth& model = *cloth.model;
  // Springs of degenerate cells are shorter, but pull no more than others do.
  const double shortest = 0.5 * model.rest_spacing;
  const Vec3f at = cloth.state.position.at(pin.sample);
  if (vec_cast<float>(pin.target) == at) return 0;  // it stands where it is to be
  const Vec3d moved = pin.target - vec_cast<double>(at);
  double lead = 0;
  for_each_beside(model, pin, [&](int copy, int r, int c) {
    if (model.inverse_mass(r, c) == 0) return;
    const double rest = length(vec_cast<double>(model.rest.at(r, c) - model.rest.at(copy)));
    const Vec3d flown = seconds * vec_cast<double>(cloth.state.velocity.at(r, c));
    lead = std::max(lead, length(moved - flown) / std::max(rest, shortest));
  });
  return lead;
}

}  // namespace

DrivenPins::DrivenPins(std::span<const PinMotion> paths, std::span<const TiedPin> tied,
                       Bodies bodies, const Cloth& cloth)
    : paths_(paths), tied_(tied), lags_(cloth.pins.size()) {
  std::vector<char> moves(cloth.pins.size(), 0);
  for (const PinMotion& motion : paths)
    for (const int pin : motion.pins) moves[static_cast<std::size_t>(pin)] = 1;
  for (const TiedPin& tie : tied)
    if (bodies[static_cast<std::size_t>(tie.body)] != nullptr)
      moves[static_cast<std::size_t>(tie.pin)] = 1;
  for (std::size_t i = 0; i < moves.size(); ++i)
    if (moves[i] == 0) standing_.push_back({i, cloth.pins[i].target, cloth.pins[i].target});
}

void DrivenPins::place(double seconds, Bodies bodies, Cloth& cloth) const {
  move_pins(paths_, seconds, cloth);
  move_tied(tied_, bodies, cloth);
}

void DrivenPins::return_standing(Cloth& cloth) {
  for (Standing& one : standing_) {
    Vec3d& target = cloth.pins[one.pin].target;
    if (target != one.put) one.place = target;
    target = one.put = one.place;
  }
}

void DrivenPins::follow(const Step& step, SimulatedCloth& cloth) {
  Cloth& model = *cloth.model;
  const double makes_up = hand_speed * (step.end - step.begin);
  return_standing(model);
  place(step.begin, step.from, model);
  for (std::size_t i = 0; i < lags_.size(); ++i) {
    const Pin& pin = model.pins[i];
    const Vec3d lag = vec_cast<double>(cloth.state.position.at(pin.sample)) - pin.target;
    const double far = length(lag), left = far - makes_up;
    lags_[i] = left > 0 ? (left / far) * lag : Vec3d{};
  }
  place(step.end, step.to, model);
  for (std::size_t i = 0; i < lags_.size(); ++i) model.pins[i].target += lags_[i];
  for (Standing& one : standing_) one.put = model.pins[one.pin].target;
}

double DrivenPins::wanted_subdivisions(const SimulatedCloth& cloth, double seconds) const {
  double lead = 0;
  for (std::size_t i = 0; i < lags_.size(); ++i)
    lead = std::max(lead, lead_of(cloth.model->pins[i], cloth, seconds));
  return lead / max_pin_lead;
}

}  // namespace weft
