#include "weft/cloth/newton/block_level.h"

#include <algorithm>

#include "weft/cloth/neighbours.h"

namespace weft {

BlockLevel::BlockLevel(Shape shape, Seams seam_classes, BendingStencil stiffness)
    : layout(std::move(shape.layout)),
      size(layout.size),
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
  const std::vector<int> chart_of = layout.chart_of();
  for (int s = 0; s < n * n; ++s)
    if (chart_of[static_cast<std::size_t>(s)] < 0) extra(s / n, s % n) = holding_stiffness;
}

namespace {

constexpr int frame = 16;
constexpr int blocks_a_row = 5, entries = 6;

StencilBlocks rows_of(const BlockStencil& stencil, int r, int c) {
  return {row_of(stencil.centre, r, c), row_of(stencil.right, r, c),
          row_of(stencil.below_left, r, c), row_of(stencil.below, r, c),
          row_of(stencil.below_right, r, c)};
}
MutableStencilBlocks rows_of(BlockStencil& stencil, int r, int c) {
  return {row_of(stencil.centre, r, c), row_of(stencil.right, r, c),
          row_of(stencil.below_left, r, c), row_of(stencil.below, r, c),
          row_of(stencil.below_right, r, c)};
}

}  // namespace

Galerkin::Rows::Rows(int cols)
    : values(static_cast<std::size_t>(cols + 2 * frame) * blocks_a_row * entries) {
  BlockRow6* const from[] = {&read.centre, &read.right, &read.below_left, &read.below,
                             &read.below_right};
  MutableBlockRow6* const to[] = {&write.centre, &write.right, &write.below_left, &write.below,
                                  &write.below_right};
  float* row = values.data() + frame;
  for (int b = 0; b < blocks_a_row; ++b)
    for (int k = 0; k < entries; ++k, row += cols + 2 * frame)
      from[b]->entry[k] = to[b]->entry[k] = row;
}

Galerkin::Galerkin(int size, int workers) : scratch_(workers) {
  for (Scratch& own : scratch_) {
    own.fine = Rows(size);
    for (Rows& half : own.half) half = Rows(size / 2 + 1);
  }
}

/// Coarsens a chart to some of its coarse rows. Around it its stencils have zeros.
template <class FineRow>
void Galerkin::coarsen_chart(std::size_t chart, const BlockLevel& fine, BlockLevel& coarse,
                             Range rows, Scratch& own, const NewtonKernels& kernels,
                             const FineRow& fine_row) {
  const Chart &from = fine.layout.charts[chart], &to = coarse.layout.charts[chart];
  // Ring buffer of the half-coarsened rows 2 q - 1, 2 q, 2 q + 1.
  const auto slot = [](int row) { return (row + 3) % 3; };
  const auto make = [&](int row) {
    Rows& half = own.half[slot(row)];
    if (row < 0 || row >= from.rows)
      std::fill(half.values.begin(), half.values.end(), 0.0F);
    else
      kernels.coarsen_columns(to.cols, fine_row(from, from.row + row, own.fine), half.write);
  };
  for (int q = rows.first; q < rows.last; ++q) {
    if (q == rows.first) make(2 * q - 1);
    make(2 * q);
    make(2 * q + 1);
    const StencilBlocks half[3] = {own.half[slot(2 * q - 1)].read, own.half[slot(2 * q)].read,
                                   own.half[slot(2 * q + 1)].read};
    kernels.coarsen_rows(to.cols, half, rows_of(coarse.stencil, to.row + q, to.col));
  }
}

template <class FineRow>
void Galerkin::coarsen_rows(const BlockLevel& fine, BlockLevel& coarse, const Workers& workers,
                            const NewtonKernels& kernels, const FineRow& fine_row) {
  Scratch& own = scratch_[workers.alone() ? 0 : workers.rank()];
  const Range mine = workers.share(coarse.size);
  const std::vector<Chart>& charts = coarse.layout.charts;
  for (std::size_t k = 0; k < charts.size(); ++k) {
    const Range rows{std::max(mine.first - charts[k].row, 0),
                     std::min(mine.last - charts[k].row, charts[k].rows)};
    if (rows.first >= rows.last) continue;
    // A wider chart may have left blocks beyond the columns of this one.
    if (charts.size() > 1) std::fill(own.fine.values.begin(), own.fine.values.end(), 0.0F);
    coarsen_chart(k, fine, coarse, rows, own, kernels, fine_row);
  }
}

void Galerkin::coarsen(const SpringHessian& springs, const BlockLevel& fine,
                       const PaddedPlane& mask, BlockLevel& coarse, const Workers& workers,
                       const NewtonKernels& kernels) {
  const auto fine_row = [&](const Chart& chart, int r, Rows& scratch) {
    const MutableStencilBlocks& rows = scratch.write;
    const MutableBlockRow6* const after[] = {&rows.right, &rows.below, &rows.below_right,
                                             &rows.below_left};
    const float* here = mask.row(r) + chart.col;
    for (int d = 0; d < 4; ++d) {
      const auto [down, right] = spring_offsets[d];
      kernels.spring_blocks(whole_vectors(chart.cols), springs.springs_row(d, r, chart.col), here,
                            mask.row(r + down) + chart.col + right, *after[d]);
    }
    StencilBlocks all = scratch.read;
    all.centre = row_of(fine.stencil.centre, r, chart.col);
    return all;
  };
  coarsen_rows(fine, coarse, workers, kernels, fine_row);
}

void Galerkin::coarsen(const BlockLevel& fine, BlockLevel& coarse, const Workers& workers,
                       const NewtonKernels& kernels) {
  const auto fine_row = [&](const Chart& chart, int r, Rows&) {
    return rows_of(fine.stencil, r, chart.col);
  };
  coarsen_rows(fine, coarse, workers, kernels, fine_row);
}

}  // namespace weft
