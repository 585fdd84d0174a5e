#include "weft/collide/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// One axis of a box at both ends of the step.
struct Axis {
  float lower_start, upper_start, lower_end, upper_end;
};

/// Raises the gaps to four boxes to those along one axis: in either order the smaller gap of both
/// ends of the step, of both orders the larger one.
inline void widen(const Axis& a, const ChildPathBoxes& b, int axis, float* gap) {
#pragma omp simd
  for (int k = 0; k < 4; ++k) {
    const float above =
        min(a.lower_start - b.upper_start[axis][k], a.lower_end - b.upper_end[axis][k]);
    const float below =
        min(b.lower_start[axis][k] - a.upper_start, b.lower_end[axis][k] - a.upper_end);
    gap[k] = max(gap[k], max(above, below));
  }
}

}  // namespace

unsigned near_children(const PathBox& node, const ChildPathBoxes& children, float reach) {
  float gap[4] = {};
  for (int axis = 0; axis < 3; ++axis)
    widen({node.lower_start[axis], node.upper_start[axis], node.lower_end[axis],
           node.upper_end[axis]},
          children, axis, gap);
  unsigned found = 0;
  for (int k = 0; k < 4; ++k) found |= static_cast<unsigned>(gap[k] <= reach) << k;
  return found;
}

}  // namespace weft::WEFT_KERNEL_SET
