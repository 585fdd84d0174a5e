#pragma once

#include <limits>
#include <span>
#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/progress.h"

namespace weft {

struct TrialOptions {
  int size = 257;
  Progress* progress = nullptr;
};
/// What a cut with a border rotation comes to.
struct TrialMap {
  int rotation = 0;
  /// After the minimisation, see DiskGeometry::energy; infinity when no valid map was found
  double energy = std::numeric_limits<double>::infinity();
  /// Surface vertex of the input, off the border, where the area-averaged stretch of the reweighted
  /// map is largest: there the want of a cut still shows. -1: none
  int worst_vertex = -1;
  /// [surface vertices of the input] area-averaged stretch after the minimisation; 0 for those
  /// that are not there. Empty when no valid map was found
  std::vector<double> stretch_at;
};

/// Maps a cut disk in full but for cures and cut short where little is gained, to see what becomes
/// of it: about 5 microseconds a triangle.
/// @pre size is enough for the cut
TrialMap try_map(const CutDisk& cut, int rotation, const TrialOptions& options);

/// The best of several rotations. @pre not empty
TrialMap try_rotations(const CutDisk& cut, std::span<const int> rotations,
                       const TrialOptions& options);

}  // namespace weft
