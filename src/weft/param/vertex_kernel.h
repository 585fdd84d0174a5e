#pragma once

#include <optional>
#include <span>

#include "weft/vec.h"

namespace weft {

/// A point in the midst of the kernel of a polygon, from which every edge turns left by exact
/// arithmetic; none if the kernel is empty or too thin for doubles.
/// @param ring  the polygon, counter-clockwise
std::optional<Vec2d> kernel_point(std::span<const Vec2d> ring);

/// Whether every edge of the polygon turns left seen from a point, by exact arithmetic.
bool sees_all(std::span<const Vec2d> ring, Vec2d point);

}  // namespace weft
