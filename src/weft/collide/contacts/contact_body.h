#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/collider.h"
#include "weft/collide/contacts/block_motion.h"
#include "weft/collide/contacts/body_query.h"
#include "weft/contact.h"

namespace weft {

/// A body with its motion in a step, for contact search.
struct ContactBody {
  int number = 0;                    ///< >= 1, as in InsideMarks
  const BodyQuery* query = nullptr;  ///< placed at the start of the step
  const Planes3* start = nullptr;
  const Planes3* end = nullptr;         ///< the start where it stands still
  double friction = 0;                  ///< of the body
  const BodyQuery* at_end = nullptr;    ///< placed at the end if it goes far; else null
  double max_approach = 0;              ///< upper bound of its approach to anything in the step [m]
  const BlockMotion* blocks = nullptr;  ///< its motion by blocks; null where it stands still
  int motion = 0;                       ///< identifier of this motion of the body
  int placement = 0;                    ///< identifier of where it is at the start
  /// Per triangle, 2 * cell + half: 2 where it lies in the body itself, as where an arm enters the
  /// side, 1 where it does so in part or leaves no room for cloth before it, 0 elsewhere; empty:
  /// all are 0. Nothing passes through any but those of 0.
  std::span<const char> buried{};

  /// @param triangle  or -1: none
  [[nodiscard]] bool is_buried(int triangle) const { return mark_of(triangle) > 0; }
  /// Whether a triangle lies wholly in the body: what is between it and the side that it passed is
  /// behind it, and belongs there.
  [[nodiscard]] bool is_crossed(int triangle) const { return mark_of(triangle) > 1; }

 private:
  [[nodiscard]] char mark_of(int triangle) const {
    return buried.empty() || triangle < 0 ? 0 : buried[static_cast<std::size_t>(triangle)];
  }
};

/// Displacement of a point of a body's surface during the step. [m]
[[nodiscard]] Vec3d displacement_of(const ContactBody& body, const BodyPoint& at);

/// A point of a cloth with its motion in the step: a sample, or a weighted mean of several.
struct ClothPoint {
  std::array<int, 4> samples{};
  std::array<float, 4> weights{1, 0, 0, 0};
  Vec3d start, displacement;   ///< [m]
  bool kept_in = false;        ///< it belongs inside the body
  bool astray = false;         ///< it starts on the wrong side of the body
  double farthest = HUGE_VAL;  ///< that it comes out in the step where it is astray [m]
};

/// A point of a cloth's triangle, for which `weights` sum to 1.
[[nodiscard]] ClothPoint point_of_triangle(const MovingCloth& cloth,
                                           const std::array<int, 3>& samples,
                                           const std::array<double, 3>& weights);

/// Gap and friction of a cloth against obstacles.
struct KeptGap {
  double gap = 0;       ///< [m]
  double friction = 0;  ///< of the cloth
};

/// A place of a cloth before a body: along the normal from the body point that is closest at the
/// start of a step. Where the place starts on the wrong side of the body, the normal leads out.
struct PlaceBefore {
  Vec3d normal;    ///< unit
  double gap = 0;  ///< at the start, < 0 on the wrong side [m]
};
[[nodiscard]] PlaceBefore place_before(const ContactBody& body, const BodyPoint& at,
                                       const ClothPoint& point);

/// Displacement of the surface before a place: that of the body point closest at the start, and
/// along the normal at least by what the surface approaches.
/// @param at_end  the body point that is closest to the place at the end of the step, or null where
/// the body does not go far, or is out of reach then [m]
[[nodiscard]] Vec3d surface_displacement(const ContactBody& body, const BodyPoint& at,
                                         const BodyPoint* at_end, const PlaceBefore& before,
                                         Vec3d place);
/// How far from a place the surface may be at the end of a step. [m]
/// @param gap  see PlaceBefore
[[nodiscard]] double reach_at_end(double gap, double approach);

/// Whether a point that moves by `displacement` comes near the surface, which moves by `along`
/// along the normal. [m]
[[nodiscard]] bool comes_near(const PlaceBefore& before, Vec3d displacement, double along,
                              const KeptGap& kept);

/// The contact of a point before a body, wherever the point goes.
[[nodiscard]] Contact contact_at(const ContactBody& body, const BodyPoint& at,
                                 const ClothPoint& point, const PlaceBefore& before,
                                 Vec3d surface_displacement, const KeptGap& kept);

/// Contact of a cloth point with a body: the half-space before the body point closest to it at the
/// start of the step; nothing where the proposal does not lead near it.
[[nodiscard]] std::optional<Contact> contact_before(const ContactBody& body, const BodyPoint& at,
                                                    const ClothPoint& point, const KeptGap& kept);

/// Coulomb friction coefficient of a pair: the geometric mean.
[[nodiscard]] double pair_friction(double a, double b);

/// Sets the offset and lift of a contact: a point that starts closer than the gap that is kept may
/// come no closer, and is lifted.
/// @param surface  along the contact's normal [m]
void put_offset(double surface, double gap_at_start, double gap, Contact& contact);

/// Makes the contact of a point on the wrong side bring it back, by its lift but no farther than
/// `farthest` [m]: the surface is taken to move as much, which is work on the cloth. No force
/// presses there, so there is no friction.
void bring_back(double farthest, Contact& contact);

}  // namespace weft
