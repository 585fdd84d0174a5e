#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "weft/collide/contacts/body_contacts.h"
#include "weft/grid.h"

namespace weft {

/// A turn and a shift.
struct RigidMotion {
  std::array<Vec3d, 3> rows;  ///< of the rotation
  Vec3d shift;                ///< [m]
  [[nodiscard]] Vec3d operator()(Vec3d at) const {
    return Vec3d{dot(rows[0], at), dot(rows[1], at), dot(rows[2], at)} + shift;
  }
};

/// The rigid motion that takes a surface from start to end, or nothing where none takes all its
/// samples there but for rounding. @param start, end  of one size [m]
[[nodiscard]] std::optional<RigidMotion> rigid_motion(const Planes3& start, const Planes3& end);

/// What refuges are looked for among.
struct SafePositionSurroundings {
  std::span<const ContactBody> bodies;
  const BodyContacts::Ground* ground = nullptr;  ///< none: null
  double carried = 0;   ///< so far from a body all goes wholly along with it [m]
  double reached = 0;   ///< so far from a body nothing goes along; more than `carried` [m]
  bool slides = false;  ///< along bodies nothing goes with them, only towards and away from them
  double held = 0;      ///< so far what stands still holds back what goes along [m]
};

/// Finds where a cloth is free at the end of a step whatever else happens in it: where it started,
/// carried along with the bodies that move close to it. The shift changes slowly from place to
/// place, so that what did not meet at the start does not meet there either.
class SafePositions {
 public:
  /// @param start   [n x n] [m]
  /// @param safe_position  [n x n] out [m]
  void find(const Planes3& start, const SafePositionSurroundings& surroundings,
            Planes3& safe_position, ThreadTeam& team);

 private:
  /// A body in motion, for what is near it.
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
