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

/// Widens extents by four samples of one row.
inline void widen_along(const SampleBlock& samples, long first, const float* origin,
                        const float* direction, float* lower, float* upper) {
  const float *x = samples.x + first, *y = samples.y + first, *z = samples.z + first;
#pragma omp simd
  for (int k = 0; k < 4; ++k) {
    const float distance = direction[0] * (x[k] - origin[0]) + direction[1] * (y[k] - origin[1]) +
                           direction[2] * (z[k] - origin[2]);
    lower[k] = min(lower[k], distance);
    upper[k] = max(upper[k], distance);
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

unsigned near_pairs(const ChildPathBoxes& a, const ChildPathBoxes& b, float reach) {
  float gap[4][4] = {};
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < 4; ++i)
      widen({a.lower_start[axis][i], a.upper_start[axis][i], a.lower_end[axis][i],
             a.upper_end[axis][i]},
            b, axis, gap[i]);
  unsigned found = 0;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) found |= static_cast<unsigned>(gap[i][k] <= reach) << (4 * i + k);
  return found;
}

Extent along(const SampleBlock& samples, const float* origin, const float* direction) {
  constexpr float far = __builtin_huge_valf();
  float lower[4] = {far, far, far, far}, upper[4] = {-far, -far, -far, -far};
  for (int r = 0; r < samples.rows; ++r) {
    const long first = r * samples.stride;
    for (int c = 0; c + 4 <= samples.cols; c += 4)
      widen_along(samples, first + c, origin, direction, lower, upper);
    if (samples.cols % 4 != 0)
      widen_along(samples, first + samples.cols - 4, origin, direction, lower, upper);
  }
  return {min(min(lower[0], lower[1]), min(lower[2], lower[3])),
          max(max(upper[0], upper[1]), max(upper[2], upper[3]))};
}

}  // namespace weft::WEFT_KERNEL_SET
