#include <algorithm>
#include <cmath>

#include "weft/cloth/newton/contact_system.h"

// Friction of contacts, and the contact history for the next step.
namespace weft {
namespace {

/// Tangential stiffness of a sticking contact, over its normal stiffness. Soft enough for the
/// rounding of positions, a tenth of a micrometre at 1 m from the origin, to be small beside
/// friction.
constexpr double sticking_stiffness = 0.1;
/// Weight of the current normal force in the friction limit, the rest being the previous limit,
/// which smooths the jitter that rounding causes in the forces.
constexpr double new_force_part = 0.5;
/// Tangential stiffnesses that differ by less than this fraction count as equal.
constexpr double same_grip = 0.03;

}  // namespace

int ContactSystem::second_of(std::size_t index) const {
  if (index < firsts_.back()) return -1;
  int first = -1, second = -1;
  for (std::size_t k = 0; k < 4; ++k)
    if (contacts_[index].weights[k] != 0)
      (contacts_[index].weights[k] < 0 ? second : first) = places_[index][k].cloth;
  return second;
}

/// Looks up the contact in the history of the last step.
void ContactSystem::recall(int index) {
  const auto positive = [&](std::size_t k) { return contacts_[index].weights[k] > 0; };
  std::size_t k = 0;
  while (k < 3 && !positive(k)) ++k;
  const ContactHistory* history = histories_[places_[index][k].cloth];
  if (history != nullptr)
    past_[index] = history->find(contacts_[index], second_of(static_cast<std::size_t>(index)));
}

/// The displacement is taken from positions: from velocities, the rounding of every step would add
/// up to creep.
ContactSystem::Motion ContactSystem::motion_of(int index, Fields position) const {
  Motion motion;
  for (std::size_t k = 0; k < 4; ++k) {
    const double w = contacts_[index].weights[k];
    if (w == 0) continue;
    const Place& at = places_[index][k];
    const PaddedVectors &x = *position[at.cloth], &x0 = *starts_[at.cloth];
    const Vec3d now{x.x(at.row, at.col), x.y(at.row, at.col), x.z(at.row, at.col)},
        start{x0.x(at.row, at.col), x0.y(at.row, at.col), x0.z(at.row, at.col)};
    motion.start += w * start;
    motion.displacement += w * (now - start);
  }
  return motion;
}

void ContactSystem::locate(int index, Fields position) {
  const Contact& contact = contacts_[index];
  const Vec3d normal = vec_cast<double>(contact.normal);
  const auto [start, displacement] = motion_of(index, position);
  const double height = dot(normal, start);
  depth_[index] = attainable_offset(index, height) - height - dot(normal, displacement);
  Vec3d relative = displacement - vec_cast<double>(contact.surface_displacement);
  // The tangential spring starts with the extension that gives the friction of the last step.
  if (past_[index] != nullptr && work_stiffness_[index] > 0)
    relative -= 1 / (sticking_stiffness * double{work_stiffness_[index]}) *
                vec_cast<double>(past_[index]->friction);
  slid_[index] = relative - dot(normal, relative) * normal;
}

/// Tangential stiffness of a contact. It sticks if friction can hold it. Otherwise the stiffness
/// gives the limiting friction at the slip distance, which for a new contact is reduced by the
/// displacement that this friction prevents.
double ContactSystem::grip_for(int index, const Sliding& sliding) const {
  const double stiffness = sticking_stiffness * work_stiffness_[index];
  const double most = contacts_[index].friction * sliding.force;
  const double held = sliding.is_new ? most * lone_compliance(index) : 0;
  if (stiffness * (sliding.distance - held) <= most) return stiffness;
  return most / (sliding.distance - held);
}

/// Normal force that limits friction.
/// @param pressed  normal stiffness with which the point came to that depth
double ContactSystem::limiting_force(int index, double depth, double pressed) const {
  const double now = pressed * std::max(0.0, depth), yields = lone_compliance(index);
  if (past_[index] != nullptr)
    return first_ ? double{past_[index]->force}
                  : now + (1 - new_force_part) * (double{past_[index]->force} - now);
  if (pressed > 0) return now;
  // A new contact is taken to stop its own point alone.
  return yields > 0 ? std::max(0.0, depth - lift_[index]) / yields : 0;
}

/// Additional slip distance, beyond that of free flight, of a point that keeps its acceleration of
/// the last step, so that its friction is right at the end of the step.
double ContactSystem::foreseen_distance(int index, double distance) const {
  if (past_[index] == nullptr) return 0;
  const double gained = past_[index]->acceleration * input_.time_step * input_.time_step;
  return std::clamp(gained, -0.5 * distance, distance);
}

/// @param moved  the displacement of its point since the linearisation
/// @param held   the force that the residual has of it
void ContactSystem::choose(int index, Vec3d moved, Vec3d held) {
  const Contact& contact = contacts_[index];
  float &k = stiffness_[index], &grip = grip_[index];
  const float k_before = k, grip_before = grip;
  const double depth = depth_after(index, moved);
  k = depth > 0 ? work_stiffness_[index] : 0.0F;
  const double force = limiting_force(index, depth, k_before);
  const bool is_new = past_[index] == nullptr && !(k_before > 0);
  double distance = length(slid_after(index, moved));
  if (first_) {
    first_slip_[index] = distance;
    distance += foreseen_distance(index, distance);
  }
  grip = k > 0 && contact.friction > 0
             ? static_cast<float>(grip_for(index, {distance, force, is_new}))
             : 0.0F;
  const bool changed = (k > 0) != (k_before > 0) ||
                       std::abs(grip - grip_before) > same_grip * std::max(grip, grip_before);
  changed_[index] = changed ? 1 : 0;
  touched_[index] = k > 0 || k_before > 0 ? 1 : 0;
  gained_[index] = vec_cast<float>(force_after(index, moved) - held);
}

void ContactSystem::measure(Fields position, Worker& worker) {
  const Range mine = share(worker);
  for (int i = mine.first; i < mine.last; ++i) {
    locate(i, position);
    force_[i] = static_cast<float>(std::max(0.0, double{stiffness_[i]} * depth_[i]));
    limiting_[i] = static_cast<float>(limiting_force(i, depth_[i], stiffness_[i]));
    const Vec3d drag = -double{grip_[i]} * slid_[i];
    const double most = double{contacts_[i].friction} * limiting_[i], has = length(drag);
    friction_[i] = vec_cast<float>((has > most ? most / has : 1.0) * drag);
    const bool slips = grip_[i] < 0.99 * sticking_stiffness * work_stiffness_[i];
    const double h = input_.time_step;
    acceleration_[i] =
        slips ? static_cast<float>((length(slid_[i]) - first_slip_[i]) / (h * h)) : 0.0F;
  }
  worker.barrier();
}

void ContactSystem::remember(std::size_t cloth, ContactHistory& history) const {
  const auto add = [&](std::size_t i, int second) {
    if (!(force_[i] > 0)) return;
    PastContact done;
    done.friction = friction_[i];
    done.force = limiting_[i];
    done.acceleration = acceleration_[i];
    history.add(contacts_[i], second, done);
  };
  for (std::size_t i = firsts_[cloth]; i < firsts_[cloth + 1]; ++i) add(i, -1);
  for (std::size_t i = firsts_.back(); i < contacts_.size(); ++i) {
    const int second = second_of(i);
    bool is_first = false;
    for (std::size_t k = 0; k < 4; ++k)
      is_first = is_first ||
                 (contacts_[i].weights[k] > 0 && places_[i][k].cloth == static_cast<int>(cloth));
    if (is_first) add(i, second);
  }
}

}  // namespace weft
