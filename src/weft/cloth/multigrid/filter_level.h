#pragma once

#include <array>
#include <vector>

#include "weft/cloth/cloth.h"

namespace weft {

/// One level of the filter's pyramid: A = M / h^2 + held + sum k (edge Laplacian), a scalar
/// operator that acts on each coordinate alike. Like forces, its rows are stored as each sample's
/// own part; a particle's row is the sum over its mates.
struct FilterLevel {
  BorderMates mates;
  /// Conductance of the edges to the right, below, below right and below left; as SpringPlane.
  std::array<Grid<float>, 4> edge;    ///< [n x n] [N/m], >= 0
  std::array<Grid<float>, 2> second;  ///< to second neighbours, finest level alone [N/m]
  Grid<float> own_weight;             ///< [n x n] own part of M / h^2 + held [N/m]
  Grid<float> own_diagonal;           ///< [n x n] own part of the diagonal [N/m]
  Grid<float> inverse_diagonal;       ///< [n x n] summed over mates; 0 where nothing moves [m/N]
  Grid<float> share;                  ///< [n x n] one over the number of mates
  bool matched = true;  ///< the finer level's mates are this level's; else it is cut along the seam

  Planes3 right;        ///< own part of the right side [N]
  Planes3 value, next;  ///< the iterate and the one that a sweep makes of it [m]
  Planes3 residual;     ///< own part [N]
  Grid<float> line;     ///< [n x 4 n] scratch: one line a row
  [[nodiscard]] int size() const { return own_weight.rows(); }
};

/// The levels of a cloth's filter, finest first, down to the coarsest that halving reaches.
/// @param time_step  h [s]
std::vector<FilterLevel> make_filter_levels(const Cloth& cloth, double time_step);

/// Renews own_weight of the coarser levels and all diagonals after own_weight of the finest changed
/// (pins, contacts). @param moves [n x n] 0 where a particle is held, else 1
void renew_weights(std::vector<FilterLevel>& levels, const Grid<float>& moves);

}  // namespace weft
