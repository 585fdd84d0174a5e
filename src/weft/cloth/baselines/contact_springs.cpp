#include "weft/cloth/baselines/contact_springs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "weft/core/contact_point.h"

namespace weft {
namespace {

/// Contact stiffness over the stiffness by which the cloth's own operator holds the point. If it is
/// stiffer, forces show rounding and the error of few iterations; if softer, motion shows the
/// remaining depth.
constexpr double relative_stiffness = 0.125;
/// A point nearer to the half-space than this fraction of the rest spacing counts as touching.
constexpr double touching = 1e-3;

/// Friction limits that differ by less than this fraction count as equal.
constexpr double same_force = 0.02;

}  // namespace

ContactSprings::ContactSprings(const Cloth& cloth) : cloth_(cloth), loads_(cloth) {}

void ContactSprings::set_contacts(std::span<const Contact> contacts, const Planes3& start,
                                  double time_step) {
  loads_.set_contacts(contacts);
  start_ = &start;
  time_step_ = time_step;
  slack_.resize(contacts.size());
  sticks_.assign(contacts.size(), 0);
  changed_.resize(contacts.size());
  for (std::vector<float>* values :
       {&force_, &friction_, &spare_, &max_friction_, &stick_stiffness_})
    values->assign(contacts.size(), 0.0F);
}

bool ContactSprings::may_press(const Contact& contact, const Planes3& now) const {
  const Vec3d n = vec_cast<double>(contact.normal);
  std::array<double, 2> before{}, after{};  // the heights of both sides
  for (std::size_t i = 0; i < contact.samples.size(); ++i) {
    const double w = contact.weights[i];
    if (w == 0) continue;
    const std::size_t side = w > 0 ? 0 : 1;
    before[side] += w * dot(n, vec_cast<double>(start_->at(contact.samples[i])));
    after[side] += w * dot(n, vec_cast<double>(now.at(contact.samples[i])));
  }
  const double min = std::min(before[0], after[0]) + std::min(before[1], after[1]);
  return contact.offset - min > -touching * cloth_.rest_spacing;
}

bool ContactSprings::update_active(const Planes3& now, const Grid<float>& inverse_diagonal,
                                   Worker& worker) {
  const std::span<const Contact> contacts = loads_.contacts();
  if (contacts.empty()) return false;
  const std::span<float> stiffness = loads_.stiffness();
  const int before = loads_.stiff();
  const Range mine = worker.share(static_cast<int>(contacts.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    const Contact& contact = contacts[i];
    if (stiffness[i] > 0 || !may_press(contact, now)) continue;
    const double own = ContactLoads::own_stiffness(contact, inverse_diagonal);
    const bool soft = contact.stiffness > 0;
    stick_stiffness_[i] = soft ? contact.stiffness : static_cast<float>(relative_stiffness * own);
    stiffness[i] = soft ? contact.stiffness : stick_stiffness_[i];
    const double offset = soft ? double{contact.offset}
                               : attainable_offset(contact, *start_, max_exit_speed * time_step_);
    slack_[i] = dot(vec_cast<double>(contact.normal), point_of(contact, *start_)) - offset;
  }
  loads_.count(worker);
  return loads_.stiff() > before;
}

/// Displacement of a contact's point since the start of the step.
Vec3d ContactSprings::moved(int index, const Place& place) const {
  const Contact& contact = loads_.contacts()[index];
  Vec3d displacement;
  for (std::size_t i = 0; i < contact.samples.size(); ++i) {
    const double w = contact.weights[i];
    if (w == 0) continue;
    const int s = contact.samples[i];
    displacement += w * (vec_cast<double>(place.from.at(s)) - vec_cast<double>(start_->at(s)) +
                         vec_cast<double>(place.move.at(s)) +
                         double{place.step_length} * vec_cast<double>(place.direction.at(s)));
  }
  return displacement;
}

double ContactSprings::depth_at(int index, const Place& place) const {
  return -slack_[index] -
         dot(vec_cast<double>(loads_.contacts()[index].normal), moved(index, place));
}

/// Displacement of a contact's point along the obstacle, relative to it.
Vec3d ContactSprings::slid(int index, const Place& place) const {
  const Contact& contact = loads_.contacts()[index];
  const Vec3d n = vec_cast<double>(contact.normal);
  const Vec3d displacement = moved(index, place) - vec_cast<double>(contact.surface_displacement);
  return displacement - dot(n, displacement) * n;
}

double ContactSprings::lone_compliance(const Contact& contact) const {
  double compliance = 0;
  for (std::size_t i = 0; i < contact.samples.size(); ++i) {
    const double w = contact.weights[i];
    const int s = contact.samples[i], n = cloth_.size;
    compliance += w * w * double{cloth_.inverse_mass(s / n, s % n)} * time_step_ * time_step_;
  }
  return compliance;
}

bool ContactSprings::update_friction(int index, const Place& place) {
  const Contact& contact = loads_.contacts()[index];
  const float k = stick_stiffness_[index];
  if (k == 0 || contact.friction == 0) return false;
  const double compliance = lone_compliance(contact);
  if (!(compliance > 0)) return false;
  const double force = force_[index] > 0 ? double{force_[index]}
                                         : std::max(0.0, depth_at(index, place)) / compliance;
  const double max = contact.friction * force, displacement = length(slid(index, place));
  // A contact without friction so far sticks if friction could stop it; with friction, if it hardly
  // moves.
  const bool stuck = sticks_[index] != 0;
  const double before = max_friction_[index];
  const bool sticks =
      max > 0 && (before > 0 ? k * displacement <= max : displacement <= max * compliance);
  sticks_[index] = sticks ? 1 : 0;
  max_friction_[index] = static_cast<float>(max);
  loads_.grip()[index] = sticks ? k : max > 0 ? static_cast<float>(max / displacement) : 0.0F;
  return sticks != stuck || (!sticks && std::abs(max - before) > same_force * max);
}

bool ContactSprings::update_friction(const Place& place, Worker& worker) {
  const Range mine = worker.share(static_cast<int>(force_.size()));
  for (int i = mine.first; i < mine.last; ++i) changed_[i] = update_friction(i, place) ? 1 : 0;
  worker.barrier();
  if (worker.rank() == 0)
    any_changed_ = std::find(changed_.begin(), changed_.end(), 1) != changed_.end();
  worker.barrier();
  return any_changed_;
}

Vec3f ContactSprings::friction_at(int index, const Place& place) const {
  const float max = max_friction_[index];
  if (max == 0) return {};
  const Vec3d displacement = slid(index, place);
  const double k = stick_stiffness_[index], distance = length(displacement);
  // The force of a slipping contact reverses smoothly.
  const bool spring = sticks_[index] != 0 || k * distance <= max;
  return vec_cast<float>((spring ? -k : -max / distance) * displacement);
}

void ContactSprings::update_forces(const Place& place, Worker& worker) {
  const std::span<const Contact> contacts = loads_.contacts();
  const Range mine = worker.share(static_cast<int>(contacts.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    const float k = loads_.stiffness()[i];
    if (k == 0) continue;
    force_[i] = static_cast<float>(double{k} * std::max(0.0, depth_at(i, place)));
    const Vec3f friction = friction_at(i, place);
    friction_[i] = length(friction);
    loads_.loads()[i] = force_[i] * contacts[i].normal + friction;
  }
  worker.barrier();
}

void ContactSprings::spare(Worker& worker) {
  const std::span<const Contact> contacts = loads_.contacts();
  const Range mine = worker.share(static_cast<int>(contacts.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    const bool slips = max_friction_[i] > 0 && sticks_[i] == 0;
    const float spent = max_friction_[i] > 0 ? friction_[i] / contacts[i].friction : 0.0F;
    spare_[i] = slips ? 0.0F : std::max(0.0F, force_[i] - spent);
  }
  worker.barrier();
}

}  // namespace weft
