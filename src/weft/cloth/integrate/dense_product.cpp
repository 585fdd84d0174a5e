#include "weft/cloth/integrate/dense_product.h"

namespace weft {
namespace {

constexpr int lanes = 16;

float folded(std::array<float, lanes>& sums) {
  for (int half = lanes / 2; half > 0; half /= 2)
    for (int i = 0; i < half; ++i) sums[i] += sums[i + half];
  return sums[0];
}

}  // namespace

Vec3f row_times(const float* row, std::ptrdiff_t stride, const Vectors3& vectors) {
  std::array<float, lanes> sx{}, sy{}, sz{};
  const float *x = vectors.x(), *y = vectors.y(), *z = vectors.z();
  for (std::ptrdiff_t j = 0; j < stride; j += lanes) {
#pragma omp simd
    for (int i = 0; i < lanes; ++i) {
      const float w = row[j + i];
      sx[i] += w * x[j + i];
      sy[i] += w * y[j + i];
      sz[i] += w * z[j + i];
    }
  }
  return {folded(sx), folded(sy), folded(sz)};
}

}  // namespace weft
