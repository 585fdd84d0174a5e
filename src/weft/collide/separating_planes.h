#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/collide/closest.h"
#include "weft/collide/surface.h"

namespace weft {

/// A plane between two features that do not meet at the start of a step. Features are convex and
/// every corner goes straight, so two that lie on their sides of one plane at both ends of the step
/// never meet in between; the plane may move meanwhile.
struct SeparatingPlane {
  Vec3d normal;         ///< unit, towards side a
  double offset_a = 0;  ///< at the end side a stays at or beyond this [m]
  double offset_b = 0;  ///< at the end side b stays at or before this [m]
  /// The same for a plane that stays where it was at the start: what does not move keeps to it.
  double still_a = 0, still_b = 0;
  std::array<int, 6> points{};  ///< of all cloths: side a's, then side b's; bodies have none here
  int count_a = 0, count_b = 0;
};

/// A convex feature of a surface in motion.
struct MovingFeature {
  std::array<Vec3d, 3> start, end;
  std::array<int, 3> points{};  ///< numbers among all cloths' samples; unused for bodies
  int count = 3;
  bool body = false;
};

struct PlaneOptions {
  double slack = 0;  ///< how far points may yet be moved aside [m]
};

enum class Separation { certain, plane, meeting };

/// Looks for a plane between two features: `certain` where they keep apart whatever their points do
/// within the slack, `plane` where `out` is needed for it, `meeting` where they touch at the start.
Separation separate(const MovingFeature& a, const MovingFeature& b, const PlaneOptions& options,
                    SeparatingPlane& out);

}  // namespace weft
