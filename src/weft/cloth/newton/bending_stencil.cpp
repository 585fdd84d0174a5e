#include "weft/cloth/newton/bending_stencil.h"

#include "weft/cloth/bending.h"

namespace weft {
namespace {

RowTriple rows_around(const PaddedVectors& field, int r) {
  return {field.row(r - 1), field.row(r), field.row(r + 1)};
}

}  // namespace

BendingStencil::BendingStencil(const BendingPlanes& bending) {
  if (!bending.active) return;
  neighbours_ = bending.diagonals ? bending_neighbours : straight_bending_neighbours;
  const int n = bending.weight[0].rows();
  for (int k = 0; k < neighbours_; ++k) {
    weights_[k] = PaddedPlane(n, n);
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) weights_[k](r, c) = bending.weight[k](r, c);
  }
}

BendingStencil BendingStencil::coarsened() const {
  BendingStencil coarse;
  if (!active()) return coarse;
  const int n = weights_[0].rows(), m = n / 2 + 1;
  coarse.neighbours_ = neighbours_;
  for (int k = 0; k < neighbours_; ++k) {
    coarse.weights_[k] = PaddedPlane(m, m);
    for (int r = 0; 2 * r < n; ++r)
      for (int c = 0; 2 * c < n; ++c) coarse.weights_[k](r, c) = 0.5F * weights_[k](2 * r, 2 * c);
  }
  return coarse;
}

void BendingStencil::bend_row(const PaddedVectors& x, int row, const NewtonKernels& kernels,
                              Row3 u) const {
  BendingRows rows{{}, neighbours_};
  for (int k = 0; k < neighbours_; ++k) rows.weight[k] = weights_[k].row(row);
  kernels.bend(whole_vectors(x.x.cols()), rows, rows_around(x, row), u);
}

void BendingStencil::unbend_row(const RowTriple& u, int row, const NewtonKernels& kernels,
                                Row3 out) const {
  BendingRows own{{}, neighbours_}, back{{}, neighbours_};
  for (int k = 0; k < neighbours_; ++k) {
    const BendingOffset to = bending_offsets[k];
    own.weight[k] = weights_[k].row(row);
    back.weight[k] = weights_[k ^ 1].row(row + to.down) + to.right;
  }
  kernels.unbend(whole_vectors(weights_[0].cols()), own, back, u, out);
}

PaddedPlane BendingStencil::diagonal(const Seams& seams) const {
  const int n = seams.size();
  PaddedPlane own(n, n), others(n, n);
  if (!active()) return own;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      for (int k = 0; k < neighbours_; ++k) {
        const BendingOffset to = bending_offsets[k];
        const float back = weights_[k ^ 1].row(r + to.down)[c + to.right];
        own(r, c) += weights_[k](r, c);
        others(r, c) += back * back;
      }
  ThreadTeam lone(1);
  lone.run([&](Worker& worker) { seams.sum(Workers(worker, true), {&own, &others}); });
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) own(r, c) = own(r, c) * own(r, c) + others(r, c);
  return own;
}

}  // namespace weft
