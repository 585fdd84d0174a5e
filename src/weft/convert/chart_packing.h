#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "weft/geometry_image.h"
#include "weft/param/border_layout.h"

namespace weft {

/// Gives charts their sizes, for a density of samples that all have in common.
/// @param scale  sides that are free to choose are about proportional to it; 0: the least ones
using SizesAtScale = std::function<std::vector<ChartSize>(double scale)>;

/// The same as below, with sizes of the caller's choice. @param max_scale  not to be gone beyond
/// @param found  set to the scale of the charts that are returned, or null
std::optional<std::vector<Chart>> pack_charts(const SizesAtScale& sizes_at, double max_scale,
                                              int size, double* found = nullptr);

/// What a chart asks of the image that it shares with others.
struct ChartShare {
  int min_side = min_image_size;  ///< of a square with border enough, samples a side
  double weight = 1;              ///< in proportion to this it gets samples, > 0
  double aspect = 1;              ///< its longer side over its shorter one
};

/// The sizes when a square chart of weight 1 has about `scale` samples a side, in an image of
/// `size`.
std::vector<ChartSize> sizes_at(std::span<const ChartShare> shares, double scale, int size);
/// A chart with at least so many intervals around it: a square as it grows on all sides, others
/// first along their longer one, as far as the image goes.
ChartSize with_border(ChartSize chart, int around, int size);
/// Beyond which no chart fits into an image.
double max_scale(std::span<const ChartShare> shares, int size);

/// Places charts side by side in an image, as large as they can be. Sides are 4 k + 1 and
/// places multiples of 4, so that two coarser levels of the image hold every chart's corners.
/// Deterministic.
/// @return in the order of `shares`; nothing where even the least sizes do not fit
std::optional<std::vector<Chart>> pack_charts(std::span<const ChartShare> shares, int size);

}  // namespace weft
