#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "weft/cloth/integrate/contact_loads.h"

namespace weft {

/// Contacts as one-sided springs along their normals, of energy k/2 max(0, depth)^2: a point beyond
/// its half-space is pushed back by k times its depth, k several times what the cloth holds it by,
/// so that it comes to rest within a small part of a micrometre, while a point that leaves is not
/// held.
///
/// What was beyond the half-space when the step began is not pushed out of it at any speed.
class ContactSprings {
 public:
  /// @param cloth  kept by reference
  explicit ContactSprings(const Cloth& cloth);

  void clear();
  /// Knows of contacts, but heeds none yet.
  /// @param contacts  must stay until the last press
  /// @param farthest  what was deeper when the step began is pushed out by no more than this [m]
  void take(std::span<const Contact> contacts, double farthest = HUGE_VAL);

  // To be called by every worker of the team, of any size.

  /// Heeds, besides those that it heeds already, the contacts that may press: whose point is beyond
  /// the half-space, or touches it, when each of the two sides is where it presses more, at the
  /// start of the step or now. Ends with a barrier.
  /// @param inverse_diagonal  [n x n] of the filter, 0 where held [m/N]
  /// @return whether there were any such
  bool heed(const Planes3& start, const Planes3& now, const Grid<float>& inverse_diagonal,
            Worker& worker);
  /// Where particles are: at from + move + way * direction, the parts of the sum apart, since
  /// depths are so small that rounding positions would drown them. [m]
  struct Place {
    const Planes3 &from, &move, &direction;
    float way = 1;
  };
  /// Computes all forces. Ends with a barrier.
  void press(const Place& place, Worker& worker);

  /// Whether no contact is heeded.
  [[nodiscard]] bool empty() const { return loads_.stiff() == 0; }
  /// The heeded contacts are stiff [N/m]; loads are forces [N].
  [[nodiscard]] const ContactLoads& loads() const { return loads_; }
  /// Of each contact, in the order in which they were taken, from the last press [N].
  [[nodiscard]] std::span<const float> forces() const { return force_; }

 private:
  [[nodiscard]] bool may_press(const Contact& contact, const Planes3& start,
                               const Planes3& now) const;
  [[nodiscard]] double depth_at(int contact, const Place& place) const;

  const Cloth& cloth_;
  ContactLoads loads_;
  double farthest_ = HUGE_VAL;  // [m]
  std::vector<float> force_;
  std::vector<double> offset_;  // that is held, where heeded [m]
};

}  // namespace weft
