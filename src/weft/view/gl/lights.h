#pragma once

#include <array>

#include "weft/drawing.h"
#include "weft/view/gl/matrix.h"

namespace weft::gl {

/// From how many sides the sky shines; each has a depth map of its own, so that its light is
/// shadowed.
inline constexpr int sky_sides = 18;

/// Where the things that throw shadows are, and all that lights them.
struct Lights {
  Vec3d centre;
  double radius = 1;  ///< of the ball around the things [m], > 0
  Frame key;          ///< key.back points at the key light
  std::array<Frame, sky_sides> sky;
  std::array<Vec3f, sky_sides> sky_direction;  ///< towards the light
  /// Weighted so that an open upward surface receives the sky's strength.
  std::array<Vec3f, sky_sides> sky_colour;
};
/// A warm key light and a sky that is brighter and cooler opposite to it.
/// @param box  of everything drawn; empty or not finite: the unit cube's
Lights make_lights(const KeyLight& key, const Box3d& box);

/// Linear RGB of light that falls on a surface facing it.
inline constexpr Vec3f key_colour{1.30F, 1.20F, 1.05F};
inline constexpr Vec3f sky_strength{0.36F, 0.40F, 0.47F};
/// What the ground throws back up.
inline constexpr Vec3f bounce_colour{0.22F, 0.205F, 0.19F};

}  // namespace weft::gl
