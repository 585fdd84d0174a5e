#pragma once

#include "weft/collide/intersections.h"

namespace weft {

/// What passed through what in a frame that was looked at.
struct FrameIntersections {
  int frame = 0;  ///< of the first frame that has as many; 0 when there are none
  IntersectionCounts counts;
};

}  // namespace weft
