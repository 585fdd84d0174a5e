#pragma once

#include <span>

#include "weft/mesh.h"
#include "weft/vec.h"

namespace weft {

/// A horizontal cut through an upright form: an ellipse around x = 0 [m].
struct Section {
  double height, half_width, front, back;  ///< front and back: largest and smallest z
};

/// The field of a form with elliptic sections, smooth in between (cubic Hermite, slopes by
/// differences); beyond the first and last height the end sections continue.
/// @param sections  heights ascending, at least two
double distance_to_sections(std::span<const Section> sections, Vec3d point);

/// Evenly spread points on a horizontal circle around the y axis.
struct Ring {
  double height = 0, radius = 0;  ///< [m]
  int count = 1;                  ///< 1: a point on the axis; otherwise >= 3
};

/// A surface of revolution through consecutive rings, the first at its lower pole: the strip
/// between two rings is filled with triangles that advance on both evenly, so that rings of
/// different counts fit. A pole of one point closes the surface. Faces outward when the rings run
/// upward on the outside.
/// @pre no two neighbours of count 1
TriangleMesh ring_mesh(std::span<const Ring> rings);

/// A closed cone on its base, tip up, its box centred on the origin.
TriangleMesh cone_mesh();
/// A closed rod along x, centred on the origin.
TriangleMesh rod_mesh();
inline constexpr double cone_radius = 0.25, cone_height = 0.6;
inline constexpr double rod_radius = 0.02, rod_length = 1;

}  // namespace weft
