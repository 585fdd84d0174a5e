#pragma once

#include <array>
#include <optional>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/contacts/block_motion.h"
#include "weft/collide/contacts/body_query.h"
#include "weft/contact.h"

namespace weft {

/// A body as contacts are looked for, in the step's motion.
struct ContactBody {
  int number = 0;                    ///< >= 1, what marks call it
  const BodyQuery* query = nullptr;  ///< placed at the start of the step
  const Planes3* start = nullptr;
  const Planes3* end = nullptr;       ///< the start where it stands still
  double friction = 0;                ///< of the body
  const BodyQuery* at_end = nullptr;  ///< placed at the end, where it goes far; else null
  double max_approach = 0;  ///< how much closer it comes to anything during the step, at most [m]
  const BlockMotion* blocks = nullptr;  ///< its parts in the step; null where it stands still
  int motion = 0;                       ///< which no other motion of it is called
};

/// How a point of a body's surface goes during the step. [m]
[[nodiscard]] Vec3d displacement_of(const ContactBody& body, const BodyPoint& at);

/// A point of a cloth in the step's motion: a sample, or a blend of several.
struct ClothPoint {
  std::array<int, 4> samples{};
  std::array<float, 4> weights{1, 0, 0, 0};
  Vec3d start, displacement;  ///< [m]
  bool kept_in = false;       ///< the body's inside is where it belongs
  bool astray = false;        ///< at the start on the body's other side
};

/// What a cloth keeps between itself and what it meets.
struct KeptGap {
  double gap = 0;       ///< [m]
  double friction = 0;  ///< of the cloth
};

/// The half-space before the point of a body that was closest to a cloth's at the start of the
/// step; nothing where the proposal does not lead near it.
[[nodiscard]] std::optional<Contact> contact_before(const ContactBody& body, const BodyPoint& at,
                                                    const ClothPoint& point, const KeptGap& kept);

/// Coulomb's coefficient of a pair.
[[nodiscard]] double pair_friction(double a, double b);

/// A point that starts closer than the gap that is kept may come no closer, and is lifted.
/// @param surface  along the contact's normal [m]
void put_offset(double surface, double gap_at_start, double gap, Contact& contact);

}  // namespace weft
