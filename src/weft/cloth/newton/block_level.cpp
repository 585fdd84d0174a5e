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
      rows(size, true, shape.finest),
      cols(size, false, shape.finest),
      rhs(size, size),
      value(size, size),
      residual(size, size),
      curved(size, size) {
  const int n = size;
  stencil = PlaneSet(n, n, shape.finest ? block_entries : stencil_blocks * block_entries);
  for (int i = 0; i < shape.workers; ++i) windows.emplace_back(3, n);
  if (shape.finest) {
    held_rows = PlaneSet(n, n, block_entries);
    held_cols = PlaneSet(n, n, block_entries);
  }
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) extra(r, c) *= bending_share;
  for (int i = 0; i < seams.class_count(); ++i)
    for (const int s : seams.samples(i).subspan(1)) extra(s / n, s % n) = holding_stiffness;
  for (const HangingNode& one : seams.hanging())
    extra(one.node / n, one.node % n) = holding_stiffness;
  const std::vector<int> chart_of = layout.chart_of();
  for (int s = 0; s < n * n; ++s)
    if (chart_of[static_cast<std::size_t>(s)] < 0) extra(s / n, s % n) = holding_stiffness;
}

Galerkin::Galerkin(int size, int workers) {
  for (int i = 0; i < workers; ++i)
    half_rows_.emplace_back(3, size / 2 + 1, stencil_blocks * block_entries);
}

/// Coarsens a chart to some of its coarse rows. Around it its stencils have zeros.
template <class CoarsenColumns>
void Galerkin::coarsen_chart(const Charts& charts, Range rows, PlaneSet& half, BlockLevel& coarse,
                             const NewtonKernels& kernels, const CoarsenColumns& coarsen_columns) {
  const Chart &from = charts.fine, &to = charts.coarse;
  // Ring buffer of the half-coarsened rows 2 q - 1, 2 q, 2 q + 1.
  const auto slot = [](int row) { return (row + 3) % 3; };
  const auto make = [&](int row) {
    if (row < 0 || row >= from.rows)
      half.clear_row(slot(row));
    else
      coarsen_columns(from, from.row + row, to.cols, rows_of(half, slot(row)));
  };
  for (int q = rows.first; q < rows.last; ++q) {
    if (q == rows.first) make(2 * q - 1);
    make(2 * q);
    make(2 * q + 1);
    const PlaneSet& made = half;
    const PlaneRows three[3] = {rows_of(made, slot(2 * q - 1)), rows_of(made, slot(2 * q)),
                                rows_of(made, slot(2 * q + 1))};
    kernels.coarsen_rows(to.cols, three, rows_of(coarse.stencil, to.row + q, to.col));
  }
}

template <class CoarsenColumns>
void Galerkin::coarsen_rows(const BlockLevel& fine, BlockLevel& coarse, const Workers& workers,
                            const NewtonKernels& kernels, const CoarsenColumns& coarsen_columns) {
  PlaneSet& half = half_rows_[workers.alone() ? 0 : workers.rank()];
  const Range mine = workers.share(coarse.size);
  const std::vector<Chart>& charts = coarse.layout.charts;
  for (std::size_t k = 0; k < charts.size(); ++k) {
    const Range rows{std::max(mine.first - charts[k].row, 0),
                     std::min(mine.last - charts[k].row, charts[k].rows)};
    if (rows.first >= rows.last) continue;
    coarsen_chart({fine.layout.charts[k], charts[k]}, rows, half, coarse, kernels, coarsen_columns);
  }
}

void Galerkin::coarsen(const SpringHessian& springs, const BlockLevel& fine,
                       const PaddedPlane& mask, BlockLevel& coarse, const Workers& workers,
                       const NewtonKernels& kernels) {
  coarsen_rows(
      fine, coarse, workers, kernels, [&](const Chart& chart, int r, int m, MutablePlaneRows half) {
        kernels.coarsen_springs(m, rows_of(fine.stencil, r, chart.col),
                                rows_of(springs.near(), r, chart.col), mask.row(r) + chart.col,
                                mask.row(r + 1) + chart.col, half);
      });
}

void Galerkin::coarsen(const BlockLevel& fine, BlockLevel& coarse, const Workers& workers,
                       const NewtonKernels& kernels) {
  coarsen_rows(fine, coarse, workers, kernels,
               [&](const Chart& chart, int r, int m, MutablePlaneRows half) {
                 kernels.coarsen_columns(m, rows_of(fine.stencil, r, chart.col), half);
               });
}

}  // namespace weft
