#include "weft/sim/motion/driven_bodies.h"

#include <algorithm>
#include <utility>

namespace weft {

void DrivenBodies::add(BodyMotion motion) {
  places_.push_back(motion.moves() ? std::make_unique<Planes3>(motion.size()) : nullptr);
  ends_.push_back(places_.back().get());
  motions_.push_back(std::move(motion));
}

void DrivenBodies::move_to(double seconds, ThreadTeam& team) noexcept {
  for (std::size_t i = 0; i < motions_.size(); ++i)
    if (places_[i]) motions_[i].place(seconds, *places_[i], team);
}

bool DrivenBodies::any_moves() const {
  return std::any_of(ends_.begin(), ends_.end(), [](const Planes3* end) { return end != nullptr; });
}

double DrivenBodies::fastest() const {
  double fastest = 0;
  for (const BodyMotion& motion : motions_) fastest = std::max(fastest, motion.fastest());
  return fastest;
}

}  // namespace weft
