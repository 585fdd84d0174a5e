#include "weft/cloth/newton/block_level.h"

namespace weft {
BlockLevel::BlockLevel(const Shape& shape, Seams seam_classes, BendingStencil stiffness)
    : size(shape.size),
      seams(std::move(seam_classes)),
      bending(std::move(stiffness)),
      extra(bending.diagonal(seams)),
      rows(size, true, shape.finest && seams.empty()),
      cols(size, false, shape.finest && seams.empty()),
      rhs(size, size),
      value(size, size),
      residual(size, size),
      curved(size, size) {
  const int n = size;
  if (shape.finest)
    stencil.centre = PaddedBlocks(n, n);
  else
    stencil = BlockStencil(n);
  for (int i = 0; i < shape.workers; ++i) windows.emplace_back(3, n);
  if (shape.finest && seams.empty()) {
    held_rows = PaddedBlocks(n, n);
    held_cols = PaddedBlocks(n, n);
  }
  if (!seams.empty()) joined = PaddedBlocks(n, n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) extra(r, c) *= bending_share;
  for (int i = 0; i < seams.class_count(); ++i)
    for (const int s : seams.samples(i).subspan(1)) extra(s / n, s % n) = holding_stiffness;
}

}  // namespace weft
