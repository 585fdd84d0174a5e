#pragma once

#include <span>

#include "weft/param/border_relaxation.h"
#include "weft/param/square_map.h"
#include "weft/progress.h"

namespace weft {

struct InteriorOptions {
  /// Border vertices that may move in the minimisation of stretch; Floater's map keeps them.
  std::span<const BorderFreedom> freedoms = {};
  int threads = 1;
  Progress* progress = nullptr;
};
/// Stages 7 and 8: maps the interior of a disk into a given convex border, without a flipped or
/// degenerate triangle.
/// @param uv  [D] positions of the border vertices given, counter-clockwise; the rest is
/// overwritten
/// @pre no chords (weft/param/chords.h); border positions distinct
/// @return whether a valid map was found; if not, uv holds the last attempt
bool map_interior(const DiskMesh& disk, std::span<Vec2d> uv, const Parameterizer& parameterizer,
                  const InteriorOptions& options = {});

}  // namespace weft
