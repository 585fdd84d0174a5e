#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "weft/convert.h"

namespace weft {

/// Whether an image is of little use although its map is valid: thin triangles of the map fold
/// where samples miss them.
bool is_poor(const Conversion& made);

/// Its stretch and folds in words.
std::string folds_of(const Conversion& made);

/// Each chart of a trial has as many triangles on average.
inline constexpr int min_triangles_of_more_charts = 32;

/// How many charts more than it has to try for an image that is poor.
struct MoreCharts {
  int first = 0;  ///< by the stretch of its charts, which falls as the root of their number
  int most = 0;   ///< so that each has samples and triangles enough; below 2: no trial is of use
  /// [triangles of the repaired mesh] those of charts that are stretched: others stay whole
  std::vector<bool> divisible{};
};
MoreCharts more_charts_for(const Conversion& made);

/// Converts to at most so many charts. @return nothing where that needs a larger image
/// @throws TopologyError as convert_mesh
using ConvertToCharts = std::function<std::optional<Conversion>(int charts)>;

/// A poor image again in more charts: of two trials at most, the second with four times as many
/// more as the first, or a quarter where the first did not fit. One that is not poor and loses no
/// more than 0.2 dB goes before those that are; of others the best PSNR does, by more than 0.5 dB.
/// The second is left out where the first is not poor and gains 6 dB.
/// The result's seconds are those of all trials, also of those that led to nothing. @pre all are
/// measured
Conversion with_more_charts(Conversion first, const MoreCharts& more,
                            const ConvertToCharts& convert);

}  // namespace weft
