#pragma once

#include "weft/core/progress.h"
#include "weft/cut/open_to_disk.h"

namespace weft {

struct AugmentOptions {
  int most_rounds = 12;
  int proxy_triangles = 10000;  ///< larger meshes are judged by one coarsened to this many
  int size = 257;               ///< of the image that is wanted
  Progress* progress = nullptr;
};
struct AugmentedCut {
  Cut cut;
  int rounds = 0;  ///< paths that were added and kept
};
/// Stage 4: lengthens the cut towards where the map is stretched most, as long as that helps: joins
/// the vertex of largest area-averaged stretch, judges by the L2 stretch after a few steps of the
/// minimisation, ends after two rounds with less than 0.5 percent gain and keeps the best. As long
/// as no map is valid, every round counts as a gain. Never makes a cut that the size cannot hold.
/// @pre repaired mesh
AugmentedCut augment_cut(const TriangleMesh& mesh, const Cut& cut, const AugmentOptions& options);

}  // namespace weft
