#pragma once

#include "weft/cut/cut_surface.h"
#include "weft/cut/open_to_disk.h"
#include "weft/param/border_layout.h"
#include "weft/progress.h"

namespace weft {

struct AugmentOptions {
  int max_rounds = 12;
  int proxy_triangles = 1500;  ///< larger meshes are evaluated on a proxy of about this size
  ChartSize size = 257;        ///< of the chart
  int threads = 1;
  Progress* progress = nullptr;
};
struct AugmentedCut {
  Cut cut;
  int rounds = 0;  ///< number of paths added and kept
};
/// Stage 4: extends the cut while that lowers the energy of the map. Every round extends it to each
/// of several vertices (that of largest stretch before the Newton steps; those far from the cut,
/// also weighted by the remaining stretch), maps each candidate at several border rotations, on a
/// coarse proxy of a large mesh, and continues with the best. Ends after a round that gains less
/// than a hundredth of the energy and keeps the best cut. While no map is valid, every round counts
/// as a gain. The cut is never too long for the chart.
/// @pre repaired mesh
AugmentedCut augment_cut(const TriangleMesh& mesh, const Cut& cut, const AugmentOptions& options);
AugmentedCut augment_cut(const CutSurface& surface, const Cut& cut, const AugmentOptions& options);

}  // namespace weft
