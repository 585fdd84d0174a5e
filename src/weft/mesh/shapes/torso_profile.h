#pragma once

#include <span>

#include "weft/vec.h"

namespace weft {

/// A horizontal cut through an upright form: an ellipse around x = 0 [m].
struct Section {
  double height, half_width, front, back;  ///< front and back: largest and least z
};

/// The field of a form with elliptic sections, smooth in between (cubic Hermite, slopes by
/// differences); beyond the first and last height the end sections go on.
/// @param sections  heights ascending, at least two
double distance_to_sections(std::span<const Section> sections, Vec3d point);

}  // namespace weft
