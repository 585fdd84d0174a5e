#include "weft/cloth/newton/line_factor.h"

#include <algorithm>

namespace weft {

LineFactor::LineFactor(int size, bool along_rows, bool held)
    : size_(size), along_rows_(along_rows), held_(held) {
  const std::size_t count = static_cast<std::size_t>(blocks()) * size * entries() * line_lanes;
  factors_.reset(static_cast<float*>(::operator new (count * sizeof(float), std::align_val_t{64})));
  std::fill(factors_.get(), factors_.get() + count, 0.0F);
}

LineBlock LineFactor::at(int block) const {
  const int first = block * line_lanes;
  return {along_rows_, first, std::min(line_lanes, size_ - first), size_};
}

float* LineFactor::factor_of(int block) const {
  return factors_.get() + static_cast<std::size_t>(block) * size_ * entries() * line_lanes;
}

void LineFactor::factor(int block, const LineMatrix& matrix, const NewtonKernels& kernels) {
  kernels.factor_lines(at(block), matrix, factor_of(block));
}

void LineFactor::factor(int block, const HeldLineMatrix& matrix, const NewtonKernels& kernels) {
  kernels.factor_held_lines(at(block), matrix, factor_of(block));
}

void LineFactor::solve(int block, const PaddedVectors& rhs, Solve how, float* scratch,
                       PaddedVectors& out, const NewtonKernels& kernels) const {
  const PlaneView right[3] = {{rhs.x.row(0), rhs.x.stride()},
                              {rhs.y.row(0), rhs.y.stride()},
                              {rhs.z.row(0), rhs.z.stride()}};
  const MutablePlaneView result[3] = {{out.x.row(0), out.x.stride()},
                                      {out.y.row(0), out.y.stride()},
                                      {out.z.row(0), out.z.stride()}};
  const auto solve_block = held_ ? kernels.solve_held_lines : kernels.solve_lines;
  solve_block(at(block), {factor_of(block), right, how.scale, how.add, scratch, result});
}

}  // namespace weft
