#include "weft/collide/untangle/tangle_marks.h"

namespace weft {

void TangleMarks::clear(const SurfaceGrid& a, const SurfaceGrid& b) {
  same_ = &a == &b;
  const std::array<const SurfaceGrid*, 2> grids{&a, &b};
  for (std::size_t side = 0; side < (same_ ? 1U : 2U); ++side) {
    const auto n = static_cast<std::size_t>(grids[side]->size());
    marks_[side].assign(n * n, 0);
  }
}

void TangleMarks::mark_layer(int side, int sample, int contour, int layer) {
  marks_[at(side)][sample] |= std::uint64_t{1} << (contour % layers + layer * layers);
}

}  // namespace weft
