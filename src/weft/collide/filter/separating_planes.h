#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/collide/contacts/closest.h"
#include "weft/collide/moving_surface.h"

namespace weft {

/// Levels of a plane along its normal: side a stays at or above `a`, side b at or below `b`. [m]
struct PlaneLevels {
  double a = 0, b = 0;
  friend bool operator==(const PlaneLevels&, const PlaneLevels&) = default;
};

/// A plane between two features that do not meet at the start of a step. Features are convex and
/// every corner moves on a straight line, so two that lie on their sides of one plane at both ends
/// of the step never meet in between; the plane may move meanwhile.
struct SeparatingPlane {
  Vec3d normal;        ///< at the start; unit, towards side a
  Vec3d turned;        ///< the normal at the end
  PlaneLevels at_end;  ///< along `turned`
  PlaneLevels still;   ///< levels between the safe positions; before a body as at_end
  bool turns = false;
  /// Levels of twice the middle Bernstein coefficient, for a plane that turns. The distance of a
  /// point along such a plane is a quadratic function of time; start, end and this coefficient keep
  /// it on its side.
  PlaneLevels halfway;
  /// Whether it turns with the proposed ends. It does for points that stay at those; for others it
  /// is straight, see straighten.
  bool follows_ends = false;
  PlaneLevels straight{};        ///< levels along `normal` of one that does
  double body_displacement = 0;  ///< how far a body on side b moves along it during the step [m]
  std::array<int, 6> points{};   ///< of all cloths: side a's, then side b's; bodies have none here
  int count_a = 0, count_b = 0;
  /// The closest points of both sides at the start, which a contact holds apart: weights of the
  /// points above, each side's sum 1; and of a body, its closest point and how far that moves.
  std::array<float, 6> weights{};
  Vec3d body_point, body_point_displacement;  // [m]
  int body = -1;                              ///< number of the body on side b, -1: none
};

/// Gives a plane that follows the proposed ends its levels along the normal at the start.
void straighten(SeparatingPlane& plane);

/// A convex feature of a moving surface: an edge or a triangle.
struct MovingFeature {
  std::array<Vec3d, 3> start, end;
  std::array<Vec3d, 3> safe_position;  ///< see SafePositions
  std::array<int, 3> points{};         ///< numbers among all cloths' samples; unused for bodies
  int count = 3;
  bool body = false;
};

struct PlaneOptions {
  double slack = 0;   ///< how far points may still be projected [m]
  bool turn = false;  ///< planes turn from the start to the safe positions
};

enum class Separation { certain, plane, meeting };

/// Finds the separating plane of two features: `certain` where they keep apart whatever their
/// points do within the slack, `plane` where `out` has to keep them apart, `meeting` where they
/// touch at the start.
Separation separate(const MovingFeature& a, const MovingFeature& b, const PlaneOptions& options,
                    SeparatingPlane& out);

}  // namespace weft
