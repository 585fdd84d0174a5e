#include "weft/collide/untangle/regions.h"

#include <algorithm>

namespace weft {

void Regions::find(const SurfaceGrid& grid, std::span<const CutEdge> cut) {
  const int n = grid.size(), count = n * n;
  sets_.reset(count);
  touched_.assign(static_cast<std::size_t>(count), 0);
  roots_.resize(static_cast<std::size_t>(count));
  sizes_.assign(static_cast<std::size_t>(count), 0);
  for (const CutEdge& edge : cut) touched_[edge[0]] = touched_[edge[1]] = 1;
  const auto join = [&](int from, int to) {
    const auto [p, q] = std::minmax({grid.point(from), grid.point(to)});
    if (touched_[p] != 0 && touched_[q] != 0) {
      const auto [first, last] = std::equal_range(cut.begin(), cut.end(), CutEdge{p, q});
      if ((last - first) % 2 != 0) return;
    }
    sets_.join(p, q);
  };
  for (int cell = 0; cell < grid.cells() * grid.cells(); ++cell)
    for (int half = 0; half < 2; ++half) {
      const std::array<int, 3> triangle = grid.triangle(cell, half);
      for (std::size_t k = 0; k < 3; ++k) join(triangle[k], triangle[(k + 1) % 3]);
    }
  for (int s = 0; s < count; ++s) {
    if (grid.point(s) != s) continue;
    roots_[s] = sets_.root(s);
    ++sizes_[roots_[s]];
  }
}

}  // namespace weft
