#pragma once

#include <functional>
#include <optional>
#include <string>

#include "weft/convert.h"

namespace weft {

/// Whether an image is of little use although its map is valid: thin triangles of the map fold
/// where samples miss them.
bool is_poor(const Conversion& made);

/// Its stretch and folds in words.
std::string folds_of(const Conversion& made);

/// Converts to at most so many charts. @return nothing where that needs a larger image
/// @throws TopologyError as convert_mesh
using ConvertToCharts = std::function<std::optional<Conversion>(int charts)>;
/// [dB]
using PsnrOf = std::function<double(const Conversion& made)>;

/// A poor image again, with twice as many charts, four times and so on, until it is not poor. Where
/// none of these is good the one of best PSNR is taken, the first with the fewest charts of equals.
/// The result's seconds are those of all trials.
Conversion with_more_charts(Conversion first, const ConvertToCharts& convert, const PsnrOf& psnr);

}  // namespace weft
