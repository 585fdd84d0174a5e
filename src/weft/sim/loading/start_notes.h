#pragma once

#include <span>
#include <string>

#include "weft/grid.h"
#include "weft/mesh.h"

namespace weft {

// What is odd about where and how large a scene begins: each is what to say about it, or empty.

/// Where all of a cloth is so far from the origin that single precision does not resolve its
/// thickness.
std::string far_off_text(const Planes3& placed, double thickness);
/// Where a cloth is hardly wider than it is thick.
std::string thick_text(const Planes3& placed, double thickness);
/// Where a body is so much larger or smaller than every cloth that its file may have another unit.
/// @param cloths  their boxes [m]
std::string unlike_text(const Box3d& body, std::span<const Box3d> cloths);
/// Where a garment is too large for every body that may wear it, or too small.
/// @param bodies  their boxes [m]
std::string unfit_text(const Box3d& garment, std::span<const Box3d> bodies);
/// The same where it is beyond doubt, so that the scene is refused.
std::string unwearable_text(const Box3d& garment, std::span<const Box3d> bodies);

}  // namespace weft
