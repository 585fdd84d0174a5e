#pragma once

#include <string>
#include <vector>

#include "weft/garment.h"

namespace weft {

/// [panels] Which are turned over so that all stitches join an oriented surface: the two of a plain
/// stitch alike, those of a turned one not.
/// @throws InputError naming the stitch that leaves the garment with one side only
std::vector<bool> panels_turned(const Pattern& pattern, const std::string& name);

}  // namespace weft
