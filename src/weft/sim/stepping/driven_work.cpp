#include "weft/sim/stepping/driven_work.h"

#include <algorithm>

#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"
#include "weft/cloth/strain_stiffening.h"

namespace weft {
namespace {

/// Normals whose mean is shorter than this are of bodies on several sides.
constexpr double one_sided = 0.8;

}  // namespace

DrivenWork::DrivenWork(const Cloth& cloth, Vec3d gravity, ThreadTeam& team, bool stiffens)
    : cloth_(cloth),
      gravity_(gravity),
      team_(team),
      springs_(cloth, team),
      bending_(cloth, team.instructions()),
      force_(cloth.size),
      driven_(static_cast<std::size_t>(cloth.size) * cloth.size),
      stiffens_(stiffens),
      nearest_(driven_.size(), -1),
      class_of_(driven_.size(), -1) {
  for (int k = 0; k < cloth.mates.class_count(); ++k)
    for (const int s : cloth.mates.copies(k)) class_of_[s] = k;
  samples_.reserve(driven_.size());
  pins_.reserve(driven_.size());
  front_.reserve(driven_.size());
  find_nearest_pins();
}

/// Labels samples ring by ring from the pins.
void DrivenWork::find_nearest_pins() {
  const int n = cloth_.size;
  pins_.clear();
  front_.clear();
  std::fill(nearest_.begin(), nearest_.end(), -1);
  const auto reach = [&](int sample, int pin) {
    const int s = cloth_.mates.representative(sample);
    if (nearest_[s] >= 0) return;
    nearest_[s] = pin;
    front_.push_back(s);
  };
  for (const Pin& pin : cloth_.pins) {
    pins_.push_back(cloth_.mates.representative(pin.sample));
    reach(pin.sample, pins_.back());
  }
  // All copies of a sample have neighbours, each within its chart.
  const auto spread = [&](int s, int pin) {
    const auto go = [&](int to) {
      if (cloth_.mates.same_chart(s, to)) reach(to, pin);
    };
    if (s >= n) go(s - n);
    if (s + n < n * n) go(s + n);
    if (s % n > 0) go(s - 1);
    if (s % n + 1 < n) go(s + 1);
  };
  for (std::size_t i = 0; i < front_.size(); ++i) {
    const int s = front_[i], of = class_of_[s];
    if (of < 0) spread(s, nearest_[s]);
    if (of >= 0)
      for (const int copy : cloth_.mates.copies(of)) spread(copy, nearest_[s]);
  }
}

DrivenWork::Driven& DrivenWork::driven(int sample) {
  Driven& found = driven_[sample];
  if (found.weight == 0) samples_.push_back(sample);
  return found;
}

void DrivenWork::add_pins(const DoneStep& step) {
  for (const Pin& pin : cloth_.pins) {
    const Vec3d displacement = vec_cast<double>(step.end.position.at(pin.sample)) -
                               vec_cast<double>(step.start.position.at(pin.sample));
    if (displacement == Vec3d{}) continue;
    Driven& found = driven(pin.sample);
    found.displacement = displacement;
    found.weight = 1;
    found.pinned = true;
  }
}

void DrivenWork::add_contacts(const PressingObstacles& obstacles) {
  for (std::size_t i = 0; i < obstacles.contacts.size(); ++i) {
    const Contact& contact = obstacles.contacts[i];
    if (contact.surface_displacement == Vec3f{}) continue;
    for (std::size_t k = 0; k < contact.samples.size(); ++k) {
      const double weight = contact.weights[k];
      if (!(weight > 0)) continue;
      const int sample = cloth_.mates.representative(contact.samples[k]);
      Driven& found = driven(sample);
      if (found.pinned) continue;
      const Vec3d way = vec_cast<double>(contact.surface_displacement),
                  normal = vec_cast<double>(contact.normal);
      const double force = i < obstacles.forces.size() ? double{obstacles.forces[i]} : 0;
      found.displacement += weight * way;
      found.normal += weight * normal;
      found.pressing += weight * force;
      found.pressed += weight * force * normal;
      found.pressing_work += weight * force * dot(normal, way);
      found.friction = std::max(found.friction, double{contact.friction});
      found.weight += weight;
    }
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

double DrivenWork::work_of(const Driven& driven, Vec3d reaction) {
  const Vec3d way = (1 / driven.weight) * driven.displacement;
  const auto friction = [&](Vec3d drag, double pressing) {
    const double most = driven.friction * pressing, has = length(drag);
    return (has > most ? most / has : 1.0) * drag;
  };
  const double size = length(driven.normal);
  if (size < one_sided * driven.weight)
    return driven.pressing_work + dot(friction(reaction - driven.pressed, driven.pressing), way);
  const Vec3d normal = (1 / size) * driven.normal;
  const double along = dot(reaction, normal);
  const double pressing = std::max({0.0, along, driven.pressing});
  return dot(pressing * normal + friction(reaction - along * normal, pressing), way);
}

Vec3d DrivenWork::reaction_on(int sample, const DoneStep& step) const {
  const double mass = cloth_.mass(sample / cloth_.size, sample % cloth_.size);
  const Vec3d gained = vec_cast<double>(step.end.velocity.at(sample)) -
                       vec_cast<double>(step.start.velocity.at(sample));
  return mass * ((1 / step.time_step) * gained - gravity_) - vec_cast<double>(force_.at(sample));
}

/// The work of the forces left on free particles, as of the pins nearest to them. @pre forces are
/// found, and driven_ holds the pins' displacements
double DrivenWork::work_on_free(const DoneStep& step) {
  const bool same = std::equal(
      pins_.begin(), pins_.end(), cloth_.pins.begin(), cloth_.pins.end(),
      [&](int s, const Pin& pin) { return s == cloth_.mates.representative(pin.sample); });
  if (!same) find_nearest_pins();
  double work = 0;
  for (int s = 0; s < cloth_.size * cloth_.size; ++s) {
    const int pin = nearest_[s];
    if (pin < 0 || pin == s || !driven_[pin].pinned) continue;
    if (!(cloth_.inverse_mass(s / cloth_.size, s % cloth_.size) > 0)) continue;
    work += dot(reaction_on(s, step), driven_[pin].displacement);
  }
  return work;
}

/// @pre driven_ holds the pins' displacements, which a filter may have shortened
Vec3d DrivenWork::mean_pin_displacement() const {
  Vec3d sum;
  for (const Pin& pin : cloth_.pins)
    sum += driven_[cloth_.mates.representative(pin.sample)].displacement;
  return cloth_.pins.empty() ? sum : (1.0 / static_cast<double>(cloth_.pins.size())) * sum;
}

/// The work of the pins by their force, or by what is left on them and on free particles, unless
/// those are ignored. @pre forces are found, and driven_ holds the pins' displacements
double DrivenWork::work_of_pins(const DoneStep& step, const std::optional<Vec3d>& force) {
  const auto moves = [&](int s) { return driven_[s].pinned; };
  if (std::none_of(samples_.begin(), samples_.end(), moves)) return 0;
  if (force) return dot(*force, mean_pin_displacement());
  double work = ignores_free_ ? 0 : work_on_free(step);
  for (const int s : samples_)
    if (driven_[s].pinned) work += dot(reaction_on(s, step), driven_[s].displacement);
  return work;
}

double DrivenWork::measure(const DoneStep& step, const PressingObstacles& obstacles,
                           std::optional<Vec3d> pin_force) noexcept {
  add_pins(step);
  add_contacts(obstacles);
  double work = 0;
  if (!samples_.empty()) {
    find_forces(step);
    work = work_of_pins(step, pin_force);
    for (const int s : samples_) {
      if (!driven_[s].pinned) work += work_of(driven_[s], reaction_on(s, step));
      driven_[s] = {};
    }
  }
  samples_.clear();
  ignores_free_ = false;
  return work;
}

}  // namespace weft
