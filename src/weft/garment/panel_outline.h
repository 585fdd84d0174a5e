#pragma once

#include <string>
#include <vector>

#include "weft/garment.h"

namespace weft {

/// The outline of a panel as border samples, and the rectangle that they bound.
struct PanelOutline {
  /// [T] counter-clockwise seen from the fabric's outer side, by the panel's own axes. T and the
  /// position of every corner of the pattern are multiples of 4.
  std::vector<Vec2d> points;
  std::vector<int> first;      ///< [edges] where on the border each edge begins, walked this way
  std::vector<int> intervals;  ///< [edges]
  bool mirrored = false;       ///< the panel's x goes the other way as the border is walked
  int start = 0;               ///< which point is at the rectangle's first row and column
  int rows = 0, cols = 0;

  /// The border samples from `point` on, mirrored where the panel is: counter-clockwise.
  [[nodiscard]] std::vector<Vec2d> border_from(int point) const;
};

/// Finds which way every outline is walked, so that all stitches join an oriented surface, and
/// shares out samples: edges that are sewn together get as many as the longer one asks for.
/// @param progress  may be null
/// @throws InputError naming the stitch that cannot be
std::vector<PanelOutline> lay_outlines(const Pattern& pattern, const std::string& name,
                                       double spacing, Progress* progress);

}  // namespace weft
