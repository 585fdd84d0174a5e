#pragma once

#include <array>

#include "weft/camera.h"
#include "weft/vec.h"

namespace weft::gl {

/// A 4 x 4 matrix, column-major as OpenGL takes it.
using Matrix = std::array<float, 16>;

/// A right-handed frame that looks along -back.
struct Frame {
  Vec3d right, up, back;
};
/// @param back  towards the eye, not zero
/// @param up    wanted direction; replaced where it is parallel to `back`
Frame frame_towards(Vec3d back, Vec3d up);

/// Projection from the world to the clip cube [-1, 1]^3, for what a camera sees between two depths.
/// @param near, far  depths in front of the eye, 0 < near < far
Matrix perspective(const Camera& camera, double aspect, double near, double far);

/// Parallel projection of a cube of half side `radius` around a centre to the clip cube [-1, 1]^3,
/// seen along -frame.back.
Matrix parallel(const Frame& frame, Vec3d centre, double radius);

/// The parallel projection with coordinates in [0, 1]^3, for reading depth textures.
Matrix parallel_texture(const Frame& frame, Vec3d centre, double radius);

}  // namespace weft::gl
