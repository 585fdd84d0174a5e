#include "weft/collide/untangle/regions.h"

#include <algorithm>

namespace weft {

int Regions::root(int sample) {
  while (parent_[sample] != sample) {
    parent_[sample] = parent_[parent_[sample]];
    sample = parent_[sample];
  }
  return sample;
}

void Regions::find(const SurfaceGrid& grid, std::span<const CutEdge> cut) {
  const int n = grid.size(), count = n * n;
  parent_.resize(static_cast<std::size_t>(count));
  touched_.assign(static_cast<std::size_t>(count), 0);
  sizes_.assign(static_cast<std::size_t>(count), 0);
  for (int s = 0; s < count; ++s) parent_[s] = s;
  for (const CutEdge& edge : cut) touched_[edge[0]] = touched_[edge[1]] = 1;
  const auto join = [&](int from, int to) {
    const auto [p, q] = std::minmax({grid.point(from), grid.point(to)});
    if (touched_[p] != 0 && touched_[q] != 0) {
      const auto [first, last] = std::equal_range(cut.begin(), cut.end(), CutEdge{p, q});
      if ((last - first) % 2 != 0) return;
    }
    const int a = root(p), b = root(q);
    parent_[std::max(a, b)] = std::min(a, b);
  };
  for (int cell = 0; cell < grid.cells() * grid.cells(); ++cell)
    for (int half = 0; half < 2; ++half) {
      const std::array<int, 3> triangle = grid.triangle(cell, half);
      for (std::size_t k = 0; k < 3; ++k) join(triangle[k], triangle[(k + 1) % 3]);
    }
  for (int s = 0; s < count; ++s) {
    if (grid.point(s) != s) continue;
    parent_[s] = root(s);
    ++sizes_[parent_[s]];
  }
}

}  // namespace weft
