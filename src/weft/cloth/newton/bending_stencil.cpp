#include "weft/cloth/newton/bending_stencil.h"

#include <algorithm>

#include "weft/cloth/bending.h"
#include "weft/cloth/neighbours.h"

namespace weft {
BendingStencil::BendingStencil(const BendingPlanes& bending) {
  if (!bending.active) return;
  neighbours_ = bending.diagonals ? bending_neighbours : straight_bending_neighbours;
  const int n = bending.weight[0].rows();
  weights_ = PlaneSet(n, n, neighbours_);
  for (int k = 0; k < neighbours_; ++k)
    for (int r = 0; r < n; ++r) std::copy_n(bending.weight[k].row(r), n, weights_.row(r, k));
}

BendingStencil BendingStencil::coarsened(const LevelLayout& fine, const LevelLayout& coarse) const {
  BendingStencil result;
  if (!active()) return result;
  result.neighbours_ = neighbours_;
  result.weights_ = PlaneSet(coarse.size, coarse.size, neighbours_);
  for (int k = 0; k < neighbours_; ++k)
    for (std::size_t i = 0; i < fine.charts.size(); ++i) {
      const Chart &from = fine.charts[i], &to = coarse.charts[i];
      for (int r = 0; 2 * r < from.rows; ++r)
        for (int c = 0; 2 * c < from.cols; ++c)
          result.weights_(to.row + r, to.col + c, k) =
              0.5F * weights_(from.row + 2 * r, from.col + 2 * c, k);
    }
  return result;
}

void BendingStencil::bend_row(const PaddedVectors& x, int row, const NewtonKernels& kernels,
                              Row3 u) const {
  kernels.bend(whole_vectors(x.x.cols()), rows_of(weights_, row), neighbours_, rows_around(x, row),
               u);
}

void BendingStencil::unbend_row(const RowTriple& u, int row, float factor,
                                const NewtonKernels& kernels, Row3 out) const {
  kernels.unbend(
      whole_vectors(weights_.cols()),
      {rows_of(weights_, row - 1), rows_of(weights_, row), rows_of(weights_, row + 1), neighbours_},
      u, factor, out);
}

PaddedPlane BendingStencil::diagonal(const Seams& seams) const {
  const int n = seams.size();
  PaddedPlane own(n, n), others(n, n);
  if (!active()) return own;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      for (int k = 0; k < neighbours_; ++k) {
        const BendingOffset to = bending_offsets[k];
        const float back = weights_(r + to.down, c + to.right, k ^ 1);
        own(r, c) += weights_(r, c, k);
        others(r, c) += back * back;
      }
  ThreadTeam lone(1);
  lone.run([&](Worker& worker) { seams.sum(Workers(worker, true), {&own, &others}); });
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) own(r, c) = own(r, c) * own(r, c) + others(r, c);
  return own;
}

CurvedBending::CurvedBending(const Cloth& cloth, InstructionSet instructions)
    : cloth_(cloth),
      active_(cloth.bending.active && cloth.bending.curved),
      pass_(cloth, instructions) {
  if (!active_) return;
  direction_ = Planes3(cloth.size);
  force_ = Planes3(cloth.size);
}

void CurvedBending::set_position(const Planes3& position, Worker& worker) {
  pass_.curve(position, worker);
}

void CurvedBending::change(const PaddedVectors& direction, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    const ConstRow3 from = direction.row(r);
    const Row3 to = row_of(direction_, r);
    std::copy_n(from.x, cloth_.size, to.x);
    std::copy_n(from.y, cloth_.size, to.y);
    std::copy_n(from.z, cloth_.size, to.z);
  }
  worker.barrier();
  pass_.curve_change(direction_, worker);
}

void CurvedBending::add_row(float factor, int row, PaddedVectors& out) {
  const Row3 force = row_of(force_, row), sum = out.row(row);
  std::fill_n(force.x, cloth_.size, 0.0F);
  std::fill_n(force.y, cloth_.size, 0.0F);
  std::fill_n(force.z, cloth_.size, 0.0F);
  pass_.add_row(-factor, row, force_);
  for (int c = 0; c < cloth_.size; ++c) {
    sum.x[c] += force.x[c];
    sum.y[c] += force.y[c];
    sum.z[c] += force.z[c];
  }
}

}  // namespace weft
