#pragma once

#include "weft/collide/kernels/body_kernels.h"

// The kernels for bodies of one instruction set, whose name WEFT_KERNEL_SET is.
namespace weft::WEFT_KERNEL_SET {

namespace {
inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }
inline float dot(float ax, float ay, float az, float bx, float by, float bz) {
  return ax * bx + ay * by + az * bz;
}
constexpr unsigned bits[16] = {1U << 0,  1U << 1,  1U << 2,  1U << 3, 1U << 4,  1U << 5,
                               1U << 6,  1U << 7,  1U << 8,  1U << 9, 1U << 10, 1U << 11,
                               1U << 12, 1U << 13, 1U << 14, 1U << 15};
}  // namespace

void find_near(const BodyTree& tree, const NearSearch& search, NearTriangles& out);
void find_near_tile(const BodyTree& tree, const NearTile& tile, TileTriangles& out);
void reach_row(int n, const KnownRow& known, const ReachRow& row, float* reach);
void leaf_extents(int leaves, int last, const float* const* rows, float* lower, float* upper);

extern const BodyKernels body_kernels;

}  // namespace weft::WEFT_KERNEL_SET
