#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "weft/collide/contacts/body_contacts.h"
#include "weft/grid.h"

namespace weft {

/// A rigid motion: a rotation, then a translation.
struct RigidMotion {
  std::array<Vec3d, 3> rows;  ///< of the rotation
  Vec3d shift;                ///< [m]
  [[nodiscard]] Vec3d operator()(Vec3d at) const {
    return Vec3d{dot(rows[0], at), dot(rows[1], at), dot(rows[2], at)} + shift;
  }
};

/// The rigid motion that maps a surface's start positions to its end positions, or nothing where
/// none does up to rounding.
/// @param start, end  of one size [m]
[[nodiscard]] std::optional<RigidMotion> rigid_motion(const Planes3& start, const Planes3& end);

/// Obstacles around a cloth and the ranges within which they shift safe positions.
struct SafePositionSurroundings {
  std::span<const ContactBody> bodies;
  const BodyContacts::Ground* ground = nullptr;  ///< none: null
  double carried = 0;   ///< distance to a body up to which points follow it fully [m]
  double reached = 0;   ///< distance from which on none follow it; more than `carried` [m]
  bool slides = false;  ///< points follow bodies along normals only, not along the surface
  double held = 0;      ///< range in which resting obstacles reduce the shift [m]
};

/// Finds safe positions of a cloth: where its points do not meet anything at the end of a step,
/// whatever the others do. A safe position is the point's start, shifted along with the bodies that
/// move close to it. The shift changes slowly in space, so that what did not meet at the start does
/// not meet there either.
class SafePositions {
 public:
  /// @param start   [n x n] [m]
  /// @param safe_position  [n x n] out [m]
  void find(const Planes3& start, const SafePositionSurroundings& surroundings,
            Planes3& safe_position, ThreadTeam& team);
  /// Points that go along with their cloth go this part of their distance from an obstacle at most.
  /// The map of starts to safe positions then differs so little from a translation that it folds
  /// nothing over.
  static constexpr double max_part_of_distance = 0.125;
  /// The same for cloth that moves as a whole while nothing else does: points go along, but near
  /// obstacles by no more than max_part_of_distance.
  /// @param obstacles    bodies and the ground; none of them may move
  /// @param translation  that of the whole cloth [m]
  static void find_along(const Planes3& start, const SafePositionSurroundings& obstacles,
                         Vec3d translation, Planes3& safe_position, ThreadTeam& team);

 private:
  /// A body with its motion, which points near it follow.
  struct Carrier {
    const ContactBody* body = nullptr;
    std::optional<RigidMotion> rigid;
    [[nodiscard]] bool stands() const { return body->start == body->end; }
    [[nodiscard]] Vec3d displacement(Vec3d start, const BodyPoint& at, bool slides) const;
  };
  [[nodiscard]] Vec3d shift_at(Vec3d start, const SafePositionSurroundings& around) const;

  std::vector<Carrier> carriers_;
};

}  // namespace weft
