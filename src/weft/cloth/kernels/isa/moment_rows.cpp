#include "weft/cloth/kernels/isa/filtering_rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// Sums go in this many lanes whatever the vector's width, so that they round alike.
constexpr int lanes = 16;

/// Adds the columns first .. first + count - 1, each to its lane.
inline __attribute__((always_inline)) void add_columns(const MomentRow& row, int first, int count,
                                                       float (*s)[lanes]) {
  const ConstRow3 position = row.position, a = row.acceleration;
  const float ox = row.about[0], oy = row.about[1], oz = row.about[2];
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const int c = first + i;
    const float m = row.mass[c] * row.owner[c];
    const float x = position.x[c] - ox, y = position.y[c] - oy, z = position.z[c] - oz;
    const float mx = m * x, my = m * y, mz = m * z;
    const float fx = m * a.x[c], fy = m * a.y[c], fz = m * a.z[c];
    s[0][i] += m;
    s[1][i] += mx;
    s[2][i] += my;
    s[3][i] += mz;
    s[4][i] += fx;
    s[5][i] += fy;
    s[6][i] += fz;
    s[7][i] += y * fz - z * fy;
    s[8][i] += z * fx - x * fz;
    s[9][i] += x * fy - y * fx;
    s[10][i] += mx * x;
    s[11][i] += my * y;
    s[12][i] += mz * z;
    s[13][i] += mx * y;
    s[14][i] += mx * z;
    s[15][i] += my * z;
  }
}

}  // namespace

void moments(int n, const MomentRow& row, double* sums) {
  float lane_sums[moment_terms][lanes] = {};
  int c = 0;
  for (; c + lanes <= n; c += lanes) add_columns(row, c, lanes, lane_sums);
  add_columns(row, c, n - c, lane_sums);
  for (int i = 0; i < moment_terms; ++i)
    for (const float lane : lane_sums[i]) sums[i] += double{lane};
}

}  // namespace weft::WEFT_KERNEL_SET
