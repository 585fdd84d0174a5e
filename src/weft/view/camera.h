#pragma once

#include <span>

#include "weft/core/planes.h"
#include "weft/core/vec.h"
#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// A perspective camera.
struct Camera {
  Vec3d eye{0, 1, 3}, target{0, 0, 0}, up{0, 1, 0};
  double vertical_angle = 0.6;  ///< field of view [rad]
};

/// The nearest camera that sees the whole box from a direction: its corners touch a frame a little
/// inside the picture. An empty or not-finite box is taken for the unit cube around the origin.
/// @param azimuth, elevation  of the eye seen from the box [rad]; azimuth 0 looks from +z
/// @param aspect              width / height
Camera frame_box(const Box3d& box, double azimuth, double elevation, double aspect);

/// The same for points: the farthest ones touch the frame. None: the unit cube.
/// @pre points are finite
Camera frame_points(std::span<const Vec3d> points, double azimuth, double elevation, double aspect);

/// How much of the half picture frame_box leaves free on the tight sides.
inline constexpr double frame_margin = 0.06;

/// The box of the finite samples; empty when there is none.
Box3d bounds(const Planes3& positions);
/// The box of the finite vertices; empty when there is none.
Box3d bounds(const TriangleMesh& mesh);

}  // namespace weft
