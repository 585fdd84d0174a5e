#include "weft/sim/stepping/driven_work.h"

#include <algorithm>

#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"
#include "weft/cloth/strain_stiffening.h"

namespace weft {
namespace {

/// Pins whose ways differ by no more move alike, as for the solver. [m]
constexpr double alike = 2e-6;

}  // namespace

DrivenWork::DrivenWork(const Cloth& cloth, Vec3d gravity, ThreadTeam& team, bool stiffens)
    : cloth_(cloth),
      gravity_(gravity),
      team_(team),
      springs_(cloth, team),
      bending_(cloth, team.instructions()),
      force_(cloth.size),
      touch_(static_cast<std::size_t>(cloth.size) * cloth.size),
      ways_(cloth),
      stiffens_(stiffens) {
  touched_.reserve(touch_.size());
  pinned_.reserve(touch_.size());
}

bool DrivenWork::begin(const DoneStep& step, const PressingObstacles& obstacles) noexcept {
  for (const int s : touched_) touch_[s] = {};
  touched_.clear();
  pinned_.clear();
  ways_.clear();
  moves_ = false;
  add_pins(step);
  for (std::size_t i = 0; i < obstacles.contacts.size(); ++i)
    add_contact(obstacles.contacts[i],
                i < obstacles.forces.size() ? double{obstacles.forces[i]} : 0.0);
  for (const int s : touched_) ways_.put(s, (1 / touch_[s].weight) * touch_[s].way);
  return moves_;
}

void DrivenWork::add_pins(const DoneStep& step) {
  for (const Pin& pin : cloth_.pins) {
    const Vec3d way = vec_cast<double>(step.end.position.at(pin.sample)) -
                      vec_cast<double>(step.start.position.at(pin.sample));
    moves_ = moves_ || way != Vec3d{};
    if (ways_.at(pin.sample) != nullptr) continue;  // a mate is pinned, too
    ways_.put(pin.sample, way, NearestWays::Holder::pin);
    pinned_.push_back(cloth_.mates.representative(pin.sample));
  }
}

void DrivenWork::add_contact(const Contact& contact, double force) {
  moves_ = moves_ || contact.surface_displacement != Vec3f{};
  const Vec3d way = vec_cast<double>(contact.surface_displacement),
              normal = vec_cast<double>(contact.normal);
  for (std::size_t k = 0; k < contact.samples.size(); ++k) {
    const double weight = contact.weights[k];
    if (!(weight > 0)) continue;
    const int sample = cloth_.mates.representative(contact.samples[k]);
    Touch& touch = touch_[sample];
    if (touch.weight == 0) {
      if (ways_.at(sample) != nullptr) continue;  // a pin holds it
      touched_.push_back(sample);
    }
    touch.way += weight * way;
    touch.pressed += weight * force * normal;
    touch.pressing_work += weight * force * dot(normal, way);
    touch.weight += weight;
  }
}

void DrivenWork::find_forces(const DoneStep& step) {
  const SpringRows::Motion motion{step.end.position, step.start.position, step.time_step};
  team_.run([&](Worker& worker) {
    if (bending_.active()) bending_.curve(step.end.position, worker);
    springs_.begin(motion, worker);
    const Range mine = worker.share(cloth_.size);
    for (int r = mine.first; r < mine.last; ++r) {
      const ConstRow3 row = springs_.row(motion, r, worker);
      std::copy_n(row.x, cloth_.size, force_.x.row(r));
      std::copy_n(row.y, cloth_.size, force_.y.row(r));
      std::copy_n(row.z, cloth_.size, force_.z.row(r));
      bending_.add_row(1, r, force_);
    }
    worker.barrier();
    if (stiffens_ && worker.rank() == 0) add_strain_limit_forces(cloth_, step.end.position, force_);
    worker.barrier();
    sum_over_mates(cloth_.mates, worker, {&force_.x, &force_.y, &force_.z});
  });
}

Vec3d DrivenWork::reaction_on(int sample, const DoneStep& step) const {
  const double mass = cloth_.mass(sample / cloth_.size, sample % cloth_.size);
  const Vec3d gained = vec_cast<double>(step.end.velocity.at(sample)) -
                       vec_cast<double>(step.start.velocity.at(sample));
  return mass * ((1 / step.time_step) * gained - gravity_) - vec_cast<double>(force_.at(sample));
}

double DrivenWork::work_on(int sample, const DoneStep& step) const {
  const Vec3d* way = ways_.at(sample);
  if (way == nullptr) return 0;
  const Touch& touch = touch_[sample];
  return touch.pressing_work + dot(reaction_on(sample, step) - touch.pressed, *way);
}

bool DrivenWork::pins_move_alike() const {
  return std::all_of(pinned_.begin(), pinned_.end(), [&](int s) {
    return length(*ways_.at(s) - *ways_.at(pinned_.front())) <= alike;
  });
}

double DrivenWork::measure(const DoneStep& step, Free free) noexcept {
  find_forces(step);
  double work = 0;
  for (const int s : pinned_) work += work_on(s, step);
  for (const int s : touched_) work += work_on(s, step);
  if (!free.any) return work;
  const bool of_pins = !free.layered || pins_move_alike();
  for (int s = 0; s < cloth_.size * cloth_.size; ++s) {
    const bool is_free = cloth_.owner(s / cloth_.size, s % cloth_.size) > 0 &&
                         cloth_.inverse_mass(s / cloth_.size, s % cloth_.size) > 0 &&
                         touch_[s].weight == 0;
    if (is_free && (of_pins || ways_.holder_of(s) != NearestWays::Holder::pin))
      work += work_on(s, step);
  }
  return work;
}

}  // namespace weft
