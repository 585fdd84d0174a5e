#pragma once

#include <string>

#include "weft/garment.h"

namespace weft {

/// The edge as errors name it: PATTERN: panel 'NAME', edge K.
std::string place_of(const Pattern& pattern, PanelEdge edge, const std::string& name);

/// Edges shorter than this are points: samples that lie closer would be stiffer than cloth is. [m]
inline constexpr double min_edge = 2.5e-3;

/// Refuses what cannot be sewn, and drops edges of almost no length together with their stitches,
/// which it notes.
/// @throws InputError as parse_pattern
void check_pattern(Pattern& pattern, const std::string& name);

}  // namespace weft
