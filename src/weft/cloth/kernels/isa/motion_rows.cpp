#include "weft/cloth/kernels/isa/dot.h"
#include "weft/cloth/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// Largest finite float; what compares as greater, or not at all, is not finite.
constexpr float most = 3.40282347e38F;

inline __attribute__((always_inline)) int not_finite(float value) {
  return static_cast<int>(!(__builtin_fabsf(value) <= most));
}

}  // namespace

RowMotion motion(int n, const float* mass, ConstRow3 position, ConstRow3 velocity) {
  const ConstRow3 p = position, v = velocity;
  float largest = 0;
  int bad = 0;
  // Neither depends on the order.
#pragma omp simd reduction(max : largest) reduction(| : bad)
  for (int c = 0; c < n; ++c) {
    const float squared = v.x[c] * v.x[c] + v.y[c] * v.y[c] + v.z[c] * v.z[c];
    largest = squared > largest ? squared : largest;
    bad |= not_finite(p.x[c]) | not_finite(p.y[c]) | not_finite(p.z[c]) | not_finite(squared);
  }
  return {0.5 * lane_dot(n, mass, v, v), largest, bad == 0};
}

}  // namespace weft::WEFT_KERNEL_SET
