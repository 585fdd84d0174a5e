#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "weft/cloth/baselines/contact_terms.h"

namespace weft {

/// Contacts as one-sided springs along their normals, of energy k/2 max(0, depth)^2: a point beyond
/// its half-space is pushed back by k times its depth, k being an eighth of what the cloth holds it
/// by, so that it comes to rest within micrometres, while a point that leaves is not held.
///
/// Coulomb's friction: a contact that presses either sticks, held by a spring along the surface, or
/// slips, with its coefficient times the normal force against the sliding. Which it does, and how
/// hard it presses for that, is looked up now and then only, so that in between the forces have a
/// potential [li20].
///
/// What was beyond the half-space when the step began is not pushed out of it at any speed.
class ContactSprings {
 public:
  /// @param cloth  kept by reference
  explicit ContactSprings(const Cloth& cloth);

  void clear() { loads_.set_contacts({}); }
  /// Knows of contacts, of which none is active yet.
  /// @param contacts  must stay until the last press
  /// @param start  positions then, by reference until the last press [m]
  void set_contacts(std::span<const Contact> contacts, const Planes3& start, double time_step);

  // To be called by every worker of the team, of any size.

  /// Makes active, besides those that are already, the contacts that may press: whose point is
  /// beyond the half-space, or touches it, when each of the two sides is where it presses more, at
  /// the start of the step or now. Ends with a barrier.
  /// @param inverse_diagonal  [n x n] of the filter, 0 where held [m/N]
  /// @return whether there were any such
  bool update_active(const Planes3& now, const Grid<float>& inverse_diagonal, Worker& worker);
  /// Where particles are: at from + move + step_length * direction, the parts of the sum apart,
  /// since depths are so small that rounding positions would drown them. [m]
  struct Place {
    const Planes3 &from, &move, &direction;
    float step_length = 1;
  };
  /// Decides which contacts stick and which slip, by their forces from the last press, or, where
  /// there was none, by what would stop their points if they were alone. Ends with a barrier.
  /// @return whether any sticks or slips otherwise than before
  bool update_friction(const Place& place, Worker& worker);
  /// Computes all forces. Ends with a barrier.
  void update_forces(const Place& place, Worker& worker);

  /// Whether no contact is heeded.
  [[nodiscard]] bool empty() const { return loads_.stiff() == 0; }
  /// The heeded contacts are stiff [N/m]; loads are forces [N].
  [[nodiscard]] const ContactLoads& loads() const { return loads_; }
  /// To be called by every worker after the last press. Ends with a barrier.
  void spare(Worker& worker);
  /// Of each contact, in the order in which they were taken: the part of the normal force, from the
  /// last press, that friction has left to spare, N - |friction| / coefficient [N].
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
  std::vector<float> max_friction_;     // as last decided [N]
  std::vector<float> stick_stiffness_;  // 0 where not heeded [N/m]
  std::vector<char> sticks_, changed_;
  bool any_changed_ = false;
  std::vector<double> slack_;  // how far from its start a point may go against the normal [m]
};

}  // namespace weft
