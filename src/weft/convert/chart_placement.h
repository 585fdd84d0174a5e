#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "weft/convert/chart_conversion.h"
#include "weft/convert/pieces.h"
#include "weft/convert/seam_curves.h"

namespace weft {

/// Every chart's rectangle in the image, and how finely the curves between charts are sampled.
struct Placement {
  int size = 0;
  std::vector<Chart> charts;
  std::vector<int> intervals;  ///< of each seam curve
};

/// Shares an image out among charts: by the area of their pieces, and to a lesser part by their
/// triangles, since small things are modelled finely where they matter. Curves get intervals by
/// their length and the density of samples beside them, a multiple of 4. Where the charts do not
/// fit, the image grows.
/// @param asked     the side that is wanted, or automatic_size
/// @param most      the side beyond which it does not grow
/// @param warnings  told when the image grew
/// @return nothing where the charts do not fit into an image of that side
std::optional<Placement> place_charts(std::span<const Piece> pieces,
                                      std::span<const ChartConversion> charts,
                                      const SeamCurves& curves, int asked, int most,
                                      std::vector<std::string>& warnings);

}  // namespace weft
