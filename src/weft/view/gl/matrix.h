#pragma once

#include <array>

#include "weft/camera.h"
#include "weft/vec.h"

namespace weft::gl {

/// 4 x 4, column by column, as OpenGL takes it.
using Matrix = std::array<float, 16>;

/// A right-handed frame that looks along -back.
struct Frame {
  Vec3d right, up, back;
};
/// @param back  towards the eye, not zero  @param up  wished; replaced where it is along `back`
Frame frame_towards(Vec3d back, Vec3d up);

/// World to the cube [-1, 1]^3 of what a camera sees between two depths.
/// @param near, far  depths in front of the eye, 0 < near < far
Matrix perspective(const Camera& camera, double aspect, double near, double far);

/// World to the cube [-1, 1]^3 of the cube of half side `radius` around a centre, seen along
/// -frame.back.
Matrix parallel(const Frame& frame, Vec3d centre, double radius);

/// The same with coordinates in [0, 1]^3, as textures are read.
Matrix parallel_texture(const Frame& frame, Vec3d centre, double radius);

}  // namespace weft::gl
