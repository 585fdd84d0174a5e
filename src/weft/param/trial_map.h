#pragma once

#include <limits>
#include <span>
#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/param/border_layout.h"
#include "weft/progress.h"

namespace weft {

struct TrialOptions {
  ChartSize size = 257;
  int threads = 1;  ///< of try_rotations
  Progress* progress = nullptr;
};
/// Result of mapping a cut disk at one border rotation.
struct TrialMap {
  int rotation = 0;
  /// Energy after the minimisation, see DiskGeometry::energy; infinity when no valid map was found
  double energy = std::numeric_limits<double>::infinity();
  /// Surface vertex of the input, off the border, where the area-averaged stretch is largest before
  /// the Newton steps, which would hide where a cut is missing. -1: none
  int worst_vertex = -1;
  /// [surface vertices of the input] area-averaged stretch after the minimisation; 0 for unused
  /// indices. Empty when no valid map was found
  std::vector<double> stretch_at;
};

/// Maps a cut disk by reweighting and Newton steps, to evaluate its cut and rotation. Few
/// iterations, no refinement from a coarser disk and no fallback: about 5 microseconds a triangle.
/// @pre size is enough for the cut
TrialMap try_map(const CutDisk& cut, int rotation, const TrialOptions& options);

/// The trial map of lowest energy among several rotations, the first of equal ones. @pre not empty
TrialMap try_rotations(const CutDisk& cut, std::span<const int> rotations,
                       const TrialOptions& options);

}  // namespace weft
