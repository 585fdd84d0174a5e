#include "weft/collide/pairs/self_clearance.h"

#include <algorithm>
#include <array>

namespace weft {
namespace {

inline float absolute(float a) { return a < 0 ? -a : a; }
inline float largest(float a, float b) { return a > b ? a : b; }

/// How far one coordinate has gone from where it was kept, row by row.
struct Change {
  const Grid<float>&now, &then;

  /// The largest difference from a common way. [m]
  [[nodiscard]] float of_points(int row, float common) const {
    const float *p = now.row(row), *q = then.row(row);
    float most = 0;
#pragma omp simd reduction(max : most)
    for (int c = 0; c < now.cols(); ++c) most = largest(most, absolute((p[c] - q[c]) - common));
    return most;
  }
  /// The largest change of an edge along the row, or down to the next one. [m]
  [[nodiscard]] float of_edges(int row) const {
    const float *p = now.row(row), *q = then.row(row);
    float most = 0;
#pragma omp simd reduction(max : most)
    for (int c = 0; c < now.cols() - 1; ++c)
      most = largest(most, absolute((p[c + 1] - q[c + 1]) - (p[c] - q[c])));
    if (row + 1 == now.rows()) return most;
    const float *below = now.row(row + 1), *below_then = then.row(row + 1);
#pragma omp simd reduction(max : most)
    for (int c = 0; c < now.cols(); ++c)
      most = largest(most, absolute((below[c] - below_then[c]) - (p[c] - q[c])));
    return most;
  }
};

}  // namespace

void SelfClearance::keep(const Planes3& positions, const Allowance& allowance) {
  kept_ = positions;
  allowance_ = allowance;
  known_ = true;
}

bool SelfClearance::covers(const Planes3& positions) const noexcept {
  if (!known_) return false;
  const std::array changes{Change{positions.x, kept_.x}, Change{positions.y, kept_.y},
                           Change{positions.z, kept_.z}};
  const int n = positions.size(), middle = n / 2;
  for (const Change& change : changes) {
    const float common = change.now(middle, middle) - change.then(middle, middle);
    for (int r = 0; r < n; ++r)
      if (change.of_points(r, common) > allowance_.room ||
          change.of_edges(r) > 2 * allowance_.slack)
        return false;
  }
  return true;
}

}  // namespace weft
