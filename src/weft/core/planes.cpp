#include <algorithm>
#include <array>
#include <cmath>

#include "weft/grid.h"

namespace weft {

double largest_displacement(const Planes3& from, const Planes3& to) noexcept {
  constexpr int lanes = 16;
  const int n = from.size();
  std::array<float, lanes> max{};
  for (int r = 0; r < n; ++r) {
    const float *ax = from.x.row(r), *ay = from.y.row(r), *az = from.z.row(r);
    const float *bx = to.x.row(r), *by = to.y.row(r), *bz = to.z.row(r);
    const auto look = [&](int c, float& farthest) {
      const float x = bx[c] - ax[c], y = by[c] - ay[c], z = bz[c] - az[c];
      const float square = x * x + y * y + z * z;
      farthest = square > farthest ? square : farthest;
    };
    int c = 0;
    for (; c + lanes <= n; c += lanes)
#pragma omp simd
      for (int lane = 0; lane < lanes; ++lane) look(c + lane, max[lane]);
    for (int lane = 0; c < n; ++c, ++lane) look(c, max[lane]);
  }
  return std::sqrt(double{*std::max_element(max.begin(), max.end())});
}

}  // namespace weft
