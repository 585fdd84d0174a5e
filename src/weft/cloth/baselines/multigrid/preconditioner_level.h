#pragma once

#include <array>
#include <vector>

#include "weft/cloth/baselines/multigrid/contact_blocks.h"
#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/kernel_table.h"

namespace weft {

/// Diagonal entry that fixes a held particle.
constexpr double held_diagonal = 1e30;

/// One level of the filter's pyramid: A = M / h^2 + held + sum k (edge Laplacian), a scalar
/// operator that acts alike on each coordinate. Like forces, its rows are stored as each sample's
/// own part; a particle's row is the sum over its mates.
struct FilterLevel {
  BorderMates mates;
  /// Conductance of the edges to the right, below, below right and below left; as SpringPlane.
  std::array<Grid<float>, 4> edge;  ///< [n x n] [N/m], >= 0
  Grid<float> own_weight;           ///< [n x n] own part of M / h^2 + held [N/m]
  Grid<float> own_diagonal;         ///< [n x n] own part of the diagonal [N/m]
  Grid<float> inverse_diagonal;     ///< [n x n] summed over mates; 0 where nothing moves [m/N]
  Grid<float> share, count;  ///< [n x n] one over the number of mates, and that; empty: no mates
  Grid<float> zeros;         ///< [1 x n] the edges above the first row
  bool matched = true;  ///< the finer level's mates are this level's; else it is cut along the seam

  ContactBlocks contacts;  ///< beside A

  Planes3 rhs;    ///< the right side, mates equal [N]
  Planes3 value;  ///< the iterate before the last sweep [m]
  /// Own part of the residual [N] on the way down; the iterate [m] on the way up.
  Planes3 result;

  [[nodiscard]] int size() const { return own_weight.rows(); }
  [[nodiscard]] OperatorRow operator_row(int row) const;
  [[nodiscard]] StencilRows stencil_rows(int row) const;  ///< of value
  [[nodiscard]] const float* share_row(int row) const {
    return share.rows() > 0 ? share.row(row) : nullptr;
  }
  [[nodiscard]] const float* count_row(int row) const {
    return count.rows() > 0 ? count.row(row) : nullptr;
  }
};

/// The levels of a cloth's filter, finest first, down to the coarsest that halving reaches.
/// @param time_step  h [s]
std::vector<FilterLevel> make_filter_levels(const Cloth& cloth, double time_step);

/// Renews own_weight of the coarser levels and all diagonals after own_weight of the finest changed
/// (pins, contacts). @param moves [n x n] 0 where a particle is held, else 1
void renew_weights(std::vector<FilterLevel>& levels, const Grid<float>& moves);

}  // namespace weft
