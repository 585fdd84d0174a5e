#include "weft/cloth/baselines/mip_levels.h"

#include <algorithm>

namespace weft {

bool halves(const BorderMates& mates) {
  if ((mates.size() - 1) % 2 != 0) return false;
  return std::all_of(mates.intervals().begin(), mates.intervals().end(), [](const MateInterval& i) {
    return i.first % 2 == 0 && i.mate % 2 == 0 && i.count % 2 == 0;
  });
}

BorderMates halved(const BorderMates& mates) {
  std::vector<MateInterval> intervals;
  for (const MateInterval& i : mates.intervals())
    intervals.push_back({i.first / 2, i.mate / 2, i.count / 2});
  return {(mates.size() - 1) / 2 + 1, std::move(intervals)};
}

void restrict_plane_row(const Grid<float>& fine, const Grid<float>* weight, int row, float* line,
                        float* out) {
  const int n = fine.rows(), r = 2 * row, last = (n - 1) / 2;
  const auto add = [&](int from, float share) {
    const float* values = fine.row(from);
    if (weight == nullptr) {
#pragma omp simd
      for (int c = 0; c < n; ++c) line[c] += share * values[c];
    } else {
      const float* weights = weight->row(from);
#pragma omp simd
      for (int c = 0; c < n; ++c) line[c] += share * (weights[c] * values[c]);
    }
  };
  std::fill(line, line + n, 0.0F);
  add(r, 1);
  if (r > 0) add(r - 1, 0.5F);
  if (r + 1 < n) add(r + 1, 0.5F);
  out[0] = line[0] + 0.5F * line[1];
  for (int c = 1; c < last; ++c) out[c] = line[2 * c] + 0.5F * (line[2 * c - 1] + line[2 * c + 1]);
  out[last] = line[n - 1] + 0.5F * line[n - 2];
}

void add_interpolated_row(const Grid<float>& coarse, int row, const float* weight, float* out) {
  const float *a = coarse.row(row / 2), *b = coarse.row((row + 1) / 2);
  const int last = coarse.rows() - 1;
  const auto add = [&](int c, float value) {
    out[c] += weight == nullptr ? value : weight[c] * value;
  };
  for (int c = 0; c < last; ++c) {
    const float here = 0.5F * (a[c] + b[c]), next = 0.5F * (a[c + 1] + b[c + 1]);
    add(2 * c, here);
    add(2 * c + 1, 0.5F * (here + next));
  }
  add(2 * last, 0.5F * (a[last] + b[last]));
}

}  // namespace weft
