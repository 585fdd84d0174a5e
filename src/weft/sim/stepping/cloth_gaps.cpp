#include "weft/sim/stepping/cloth_gaps.h"

#include <algorithm>

namespace weft {
namespace {

/// The gap grows from the thickness of the fabric to this part of the cloth's rest spacing, so that
/// the gentle curvature of a body does not show through between two samples, but to no more than a
/// few thicknesses, or coarse cloths would float.
constexpr double gap_in_spacings = 1.0 / 3, max_gap_in_thicknesses = 3;

/// Largest gap between parts of cloth, in rest spacings; a larger one would lock folds.
constexpr double max_self_gap_in_spacings = 0.25;

}  // namespace

double self_gap_of(const Cloth& cloth) {
  return std::min(cloth.material.thickness, max_self_gap_in_spacings * cloth.rest_spacing);
}

double gap_of(const Cloth& cloth) {
  const double thickness = cloth.material.thickness;
  return std::clamp(gap_in_spacings * cloth.rest_spacing, thickness,
                    max_gap_in_thicknesses * thickness);
}

}  // namespace weft
