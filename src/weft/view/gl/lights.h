#pragma once

#include <array>

#include "weft/drawing.h"
#include "weft/view/gl/matrix.h"

namespace weft::gl {

/// Number of directions of skylight; each has a depth map of its own for its shadows.
inline constexpr int sky_sides = 18;

/// Bounding sphere of the shadow casters, and all light sources.
struct Lights {
  Vec3d centre;
  double radius = 1;  ///< of the bounding sphere [m], > 0
  Frame key;          ///< key.back points at the key light
  std::array<Frame, sky_sides> sky;
  std::array<Vec3f, sky_sides> sky_direction;  ///< towards the light
  /// Scaled so that an unoccluded horizontal surface receives the sky's strength.
  std::array<Vec3f, sky_sides> sky_colour;
};
/// A warm key light and a sky that is brighter and cooler opposite to it.
/// @param box  of everything drawn; empty, a point or not finite: a sphere of radius 1 at the
/// origin
Lights make_lights(const KeyLight& key, const Box3d& box);

/// Linear RGB of light that falls on a surface facing it.
inline constexpr Vec3f key_colour{1.30F, 1.20F, 1.05F};
inline constexpr Vec3f sky_strength{0.36F, 0.40F, 0.47F};
/// Light reflected upwards by the ground.
inline constexpr Vec3f bounce_colour{0.22F, 0.205F, 0.19F};

}  // namespace weft::gl
