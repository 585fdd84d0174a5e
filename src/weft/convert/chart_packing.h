#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "weft/geometry_image.h"

namespace weft {

/// Gives square charts their sides, for a density of samples that all have in common.
/// @param scale  sides that are free to choose are about proportional to it; 0: the least ones
using SidesAtScale = std::function<std::vector<int>(double scale)>;

/// The same as below, with sides of the caller's choice. @param max_scale  not to be gone beyond
/// @param found  set to the scale of the charts that are returned, or null
std::optional<std::vector<Chart>> pack_charts(const SidesAtScale& sides_at, double max_scale,
                                              int size, double* found = nullptr);

/// What a square chart asks of the image that it shares with others.
struct ChartShare {
  int min_side = min_image_size;  ///< samples a side that it needs at least
  double weight = 1;              ///< in proportion to this it gets samples, > 0
};

/// The sides when a chart of weight 1 has about `scale` samples a side.
std::vector<int> sides_at(std::span<const ChartShare> shares, double scale);
/// Beyond which no chart fits into an image.
double max_scale(std::span<const ChartShare> shares, int size);

/// Places square charts side by side in an image, as large as they can be. Sides are 4 k + 1 and
/// places multiples of 4, so that two coarser levels of the image hold every chart's corners.
/// Deterministic.
/// @return in the order of `shares`; nothing where even the least sides do not fit
std::optional<std::vector<Chart>> pack_charts(std::span<const ChartShare> shares, int size);

}  // namespace weft
