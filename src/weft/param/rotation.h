#pragma once

#include "weft/param/trial_map.h"

namespace weft {

/// The trial map of lowest energy of four border rotations. Those of a square are spread evenly
/// over one side: rotating by a whole side only rotates the map. Those of another chart are spread
/// over half its border, and the first puts its ends where the border folds flattest.
/// @pre the chart has room for the cut
TrialMap try_chart(const CutDisk& cut, const TrialOptions& options);

struct RotationOptions {
  ChartSize size = 257;
  int count = 8;
  /// Rotations are multiples of it where the chart is large enough: of four, nodes of the cut can
  /// lie on two coarser levels.
  int unit = 1;
  int threads = 1;
};
/// The border rotation (border position of the first path's first node) of lowest energy among
/// about `count` candidates, spread as those of try_chart, and the neighbours of the best at half
/// the spacing; of a chart that is no square at ever smaller spacings. Candidates are evaluated by
/// trial maps (weft/param/trial_map.h), on a coarser mesh where the disk has more than 2000
/// triangles.
/// @pre as try_chart
int choose_rotation(const CutDisk& cut, RotationOptions options);

/// The border position, of rotation 0, about which the border folds onto itself most closely: its
/// points as far before it as behind it are nearest to each other in space, in the mean square. It
/// is the middle of an end of a strip; half the border away is the middle of the other.
int flattest_fold(const CutDisk& cut, ChartSize size);

}  // namespace weft
