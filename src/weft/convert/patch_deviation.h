#pragma once

#include <span>

#include "weft/convert/sliding_samples.h"

namespace weft {

/// How far a piece of the surface and the triangles that stand for it lie apart.
struct PatchDeviation {
  double largest = 0;  ///< in spacings of the grid, as measured by the triangles' mean area
  double rms = 0;      ///< in spacings

  /// @param on_surface  points whose distances from the triangles count; of the triangles, the
  ///                    distances of their middles from the surface do
  static PatchDeviation of(std::span<const Corners> triangles,
                           std::span<const SurfaceSample> on_surface,
                           const SlidingSurface& surface);
};

}  // namespace weft
