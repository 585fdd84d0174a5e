#include "weft/sim/loading/start_notes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "weft/sim/placement.h"

namespace weft {
namespace {

/// Numbers of single precision that a thickness is to have, thicknesses that a cloth is to be wide.
constexpr double min_steps = 8, min_thicknesses = 12;
/// Sizes of bodies over those of cloths that are taken for a mistake; 100 and more come of units.
constexpr double unlike = 50;
/// Sizes of garments over those of bodies, or the other way round, that are taken for a mistake:
/// inches taken for centimetres are 2.5. Collars and cuffs are small.
constexpr double too_large = 2.3, too_small = 20;
/// The same beyond any doubt: nobody wears that.
constexpr double far_too_large = 4, far_too_small = 60;

double size_of(const Box3d& box) {
  const Vec3d sides = box.upper - box.lower;
  return std::max({sides.x, sides.y, sides.z});
}

}  // namespace

std::string far_off_text(const Planes3& placed, double thickness) {
  const Box3d box = box_of(placed);
  const auto away = [](double lower, double upper) { return std::max({lower, -upper, 0.0}); };
  const double nearest = std::max({away(box.lower.x, box.upper.x), away(box.lower.y, box.upper.y),
                                   away(box.lower.z, box.upper.z)});
  const double step = 0x1p-23 * nearest;
  if (min_steps * step <= thickness) return {};
  return fmt::format(
      "begins {:.2g} m from the origin, where positions are {:.2g} m apart and its thickness of "
      "{:.2g} m is lost: move all nearer to the origin",
      nearest, step, thickness);
}

std::string thick_text(const Planes3& placed, double thickness) {
  const double size = size_of(box_of(placed));
  if (size >= min_thicknesses * thickness) return {};
  return fmt::format(
      "is {:.2g} m across, with a thickness of {:.2g} m: is the unit of its file right?", size,
      thickness);
}

std::string unlike_text(const Box3d& body, std::span<const Box3d> cloths) {
  const double size = size_of(body);
  double nearest = HUGE_VAL, other = 0;
  for (const Box3d& cloth : cloths) {
    const double ratio = std::abs(std::log(size / size_of(cloth)));
    if (!(ratio < nearest)) continue;
    nearest = ratio;
    other = size_of(cloth);
  }
  if (!(nearest < HUGE_VAL) || nearest < std::log(unlike)) return {};
  return fmt::format("is {:.3g} m across, and cloth {:.3g} m: is the unit of its file right?", size,
                     other);
}

namespace {

/// The size of a garment beside that of the largest body, where it is so many times as large as
/// that, or as small.
std::string misfit_text(const Box3d& garment, std::span<const Box3d> bodies, double large,
                        double small) {
  double largest = 0;
  for (const Box3d& body : bodies) largest = std::max(largest, size_of(body));
  const double size = size_of(garment);
  if (largest == 0 || (size <= large * largest && size * small >= largest)) return {};
  return fmt::format("is {:.3g} m across, and the largest body {:.3g} m", size, largest);
}

}  // namespace

std::string unfit_text(const Box3d& garment, std::span<const Box3d> bodies) {
  const std::string sizes = misfit_text(garment, bodies, too_large, too_small);
  return sizes.empty() ? sizes : sizes + ": is units_in_meter of its pattern right?";
}

std::string unwearable_text(const Box3d& garment, std::span<const Box3d> bodies) {
  return misfit_text(garment, bodies, far_too_large, far_too_small);
}

}  // namespace weft
