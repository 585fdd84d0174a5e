#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/collide/contacts/closest.h"
#include "weft/collide/moving_surface.h"

namespace weft {

/// Side a stays at or beyond one, side b at or before the other. [m]
struct PlaneLevels {
  double a = 0, b = 0;
  friend bool operator==(const PlaneLevels&, const PlaneLevels&) = default;
};

/// A plane between two features that do not meet at the start of a step. Features are convex and
/// every corner goes straight, so two that lie on their sides of one plane at both ends of the step
/// never meet in between; the plane may move meanwhile.
struct SeparatingPlane {
  Vec3d normal;        ///< unit, towards side a; at the start
  Vec3d turned;        ///< the same at the end
  PlaneLevels at_end;  ///< along `turned`
  PlaneLevels still;   ///< the same for a plane between the refuges: what stays there keeps to it
  bool turns = false;
  /// How far a point is along a plane that turns is a quadratic function of time: its start, its
  /// end and this between, twice the middle Bernstein coefficient, keep it on its side.
  PlaneLevels halfway;
  double body_displacement = 0;  ///< how far a body on side b moves along it during the step [m]
  std::array<int, 6> points{};   ///< of all cloths: side a's, then side b's; bodies have none here
  int count_a = 0, count_b = 0;
};

/// A convex feature of a surface in motion.
struct MovingFeature {
  std::array<Vec3d, 3> start, end;
  std::array<Vec3d, 3> safe_position;  ///< where it is free at the end whatever the others do
  std::array<int, 3> points{};         ///< numbers among all cloths' samples; unused for bodies
  int count = 3;
  bool body = false;
};

struct PlaneOptions {
  double slack = 0;   ///< how far points may yet be moved aside [m]
  bool turn = false;  ///< planes turn as the refuges have turned against the start
};

enum class Separation { certain, plane, meeting };

/// Looks for a plane between two features: `certain` where they keep apart whatever their points do
/// within the slack, `plane` where `out` is needed for it, `meeting` where they touch at the start.
Separation separate(const MovingFeature& a, const MovingFeature& b, const PlaneOptions& options,
                    SeparatingPlane& out);

}  // namespace weft
