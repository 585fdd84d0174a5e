#pragma once

#include "weft/cut/open_to_disk.h"
#include "weft/progress.h"

namespace weft {

struct AugmentOptions {
  int max_rounds = 12;
  int proxy_triangles = 1500;  ///< larger meshes are judged by one coarsened to this many
  int size = 257;              ///< of the image that is wanted
  Progress* progress = nullptr;
};
struct AugmentedCut {
  Cut cut;
  int rounds = 0;  ///< paths that were added and kept
};
/// Stage 4: lengthens the cut as long as that helps. Every round tries several vertices (where the
/// first map was stretched most; those far from the cut, also weighed by the stretch that is left
/// there) at several border rotations, maps each in full on a coarse proxy and goes on with the
/// best; ends after a round that gains less than a hundredth of the energy and keeps the best. As
/// long as no map is valid, every round counts as a gain. Never makes a cut that the size cannot
/// hold.
/// @pre repaired mesh
AugmentedCut augment_cut(const TriangleMesh& mesh, const Cut& cut, const AugmentOptions& options);

}  // namespace weft
