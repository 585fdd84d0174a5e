#pragma once

#include <variant>

namespace weft {

/// Distortion of a map.
struct MapQuality {
  int flipped = 0;          ///< inverted triangles, by exact arithmetic
  int degenerate = 0;       ///< triangles of no area, by exact arithmetic
  double stretch_l2 = 0;    ///< root of the area-weighted mean square stretch, scaled so that a map
                            ///< that keeps all areas and angles has 1 [sander01]
  double stretch_linf = 0;  ///< largest singular value over all triangles, in the same scale
};

/// Floater's shape-preserving weights [floater97], without optimisation.
struct FloaterOptions {};
/// A map of a coarse version of the disk by symmetric positive weights, reweighted by stretch
/// [yoshizawa04], then Newton steps on the stretch itself; refined to the whole disk.
struct StretchOptions {
  int iterations = 10;    ///< of reweighting, at most; the best iterate is kept
  int newton_steps = 60;  ///< at most; they end when they gain little. 0: only reweighting, of the
                          ///< whole disk
};
using Parameterizer = std::variant<StretchOptions, FloaterOptions>;

}  // namespace weft
