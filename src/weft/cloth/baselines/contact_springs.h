#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "weft/cloth/baselines/contact_terms.h"

namespace weft {

/// Contacts as one-sided springs along their normals, of energy k/2 max(0, depth)^2: a point beyond
/// its half-space is pushed back by k times its depth, while a point that leaves is not held. k is
/// an eighth of the stiffness by which the cloth holds the point, so that it comes to rest within
/// micrometres.
///
/// Coulomb's friction: an active contact either sticks, held by a tangential spring, or slips, with
/// the friction coefficient times the normal force against the slip. Which of both, and the normal
/// force in it, is updated only from time to time, so that the forces have a potential in between
/// [li20].
///
/// A penetration at the start of the step is resolved at a bounded speed.
class ContactSprings {
 public:
  /// @param cloth  kept by reference
  explicit ContactSprings(const Cloth& cloth);

  void clear() { loads_.set_contacts({}); }
  /// Replaces all contacts; none is active yet.
  /// @param contacts  must stay until the last use
  /// @param start  positions then, by reference until the last use [m]
  void set_contacts(std::span<const Contact> contacts, const Planes3& start, double time_step);

  // To be called by every worker of the team, of any size.

  /// Activates, besides the active contacts, those that may press: whose point is beyond the
  /// half-space, or touches it, with each of the two sides at its start or its present position,
  /// whichever presses more. Ends with a barrier.
  /// @param inverse_diagonal  [n x n] of the filter, 0 where held [m/N]
  /// @return whether any was activated
  bool update_active(const Planes3& now, const Grid<float>& inverse_diagonal, Worker& worker);
  /// The positions from + move + step_length * direction. The terms are kept apart, since depths
  /// are so small that the rounding of positions would drown them. [m]
  struct Place {
    const Planes3 &from, &move, &direction;
    float step_length = 1;
  };
  /// Decides which contacts stick and which slip, by their forces from the last update_forces, or,
  /// without one, by the force that would stop their points if they were alone. Ends with a
  /// barrier.
  /// @return whether any contact changed
  bool update_friction(const Place& place, Worker& worker);
  /// Computes all forces. Ends with a barrier.
  void update_forces(const Place& place, Worker& worker);

  /// Whether no contact is active.
  [[nodiscard]] bool empty() const { return loads_.stiff() == 0; }
  /// Active contacts have a stiffness [N/m]; loads are forces [N].
  [[nodiscard]] const ContactLoads& loads() const { return loads_; }
  /// Computes forces(). To be called by every worker after the last update_forces. Ends with a
  /// barrier.
  void spare(Worker& worker);
  /// The part of each contact's normal force that friction leaves, N - |friction| / coefficient, in
  /// the order of set_contacts [N].
  [[nodiscard]] std::span<const float> forces() const { return spare_; }

 private:
  [[nodiscard]] bool may_press(const Contact& contact, const Planes3& now) const;
  [[nodiscard]] Vec3d moved(int contact, const Place& place) const;
  [[nodiscard]] double depth_at(int contact, const Place& place) const;
  [[nodiscard]] Vec3d slid(int contact, const Place& place) const;
  /// h^2 over the mass of a contact's point. [m/N]
  [[nodiscard]] double lone_compliance(const Contact& contact) const;
  bool update_friction(int contact, const Place& place);
  [[nodiscard]] Vec3f friction_at(int contact, const Place& place) const;

  const Cloth& cloth_;
  ContactLoads loads_;
  const Planes3* start_ = nullptr;
  double time_step_ = 0;  // [s]
  std::vector<float> force_, friction_, spare_;
  std::vector<float> max_friction_;     // by the last update_friction [N]
  std::vector<float> stick_stiffness_;  // 0 where not active [N/m]
  std::vector<char> sticks_, changed_;
  bool any_changed_ = false;
  std::vector<double> slack_;  // how far a point may move from its start against the normal [m]
};

}  // namespace weft
