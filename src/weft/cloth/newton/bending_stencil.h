#pragma once

#include <array>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/newton_kernels.h"
#include "weft/cloth/newton/padded_planes.h"
#include "weft/cloth/newton/seams.h"

namespace weft {

/// The quadratic part of bending, |M x|^2 / 2, as weights of the eight neighbours, on the finest
/// level and, with the weights of every second sample at twice the spacing, on coarser ones: there
/// areas count four times and second differences a quarter, so M's weights a half.
class BendingStencil {
 public:
  BendingStencil() = default;
  explicit BendingStencil(const BendingPlanes& bending);
  [[nodiscard]] BendingStencil coarsened() const;

  [[nodiscard]] bool active() const { return neighbours_ > 0; }
  /// u = M x, own part of a row, from -1 to n.
  void bend_row(const PaddedVectors& x, int row, const NewtonKernels& kernels, Row3 u) const;
  /// out += M^T u, own part of a row. @param u  around the row, summed over seam copies
  void unbend_row(const RowTriple& u, int row, const NewtonKernels& kernels, Row3 out) const;
  /// The diagonal of M^T M, summed over seam copies. [N/m]
  [[nodiscard]] PaddedPlane diagonal(const Seams& seams) const;
  /// (M x)_i of a scalar field, own part.
  [[nodiscard]] float weight(int neighbour, int row, int col) const {
    return weights_[neighbour](row, col);
  }
  [[nodiscard]] int neighbours() const { return neighbours_; }

 private:
  int neighbours_ = 0;  // 0, 4 or 8
  std::array<PaddedPlane, bending_neighbours> weights_;
};

}  // namespace weft
