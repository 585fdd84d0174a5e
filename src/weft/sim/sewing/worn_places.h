#pragma once

#include <optional>
#include <span>
#include <vector>

#include "weft/garment.h"
#include "weft/sim/motion/attachments.h"
#include "weft/simulation.h"

namespace weft {

/// Where a garment is to be on the body that wears it: the edges of each of its labels, a collar or
/// a waist, are where the pattern places them, and go with what is nearest of the bodies there. A
/// garment without labels is taken as a whole.
class WornPlaces {
 public:
  WornPlaces() = default;
  /// @param placed  samples where the run begins [n x n] [m]
  /// @param bodies  where they are then, in the scene's order; may be none
  WornPlaces(const Garment& garment, const Planes3& placed, std::span<const TiedSurface> bodies);

  /// How far the label that has sunk the most is below its place, on the mean of its samples. [m]
  /// @param now  of the garment's samples [n x n] [m]
  [[nodiscard]] double sunk(const Planes3& now, std::span<const PlacedBody> bodies) const;

 private:
  struct Place {
    std::vector<int> samples;
    Vec3d middle;                     // of these, where the run begins [m]
    std::optional<TiedPlace> tied{};  // none where no body has area
  };
  std::vector<Place> places_;
};

}  // namespace weft
