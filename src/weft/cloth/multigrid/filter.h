#pragma once

#include <vector>

#include "weft/cloth/multigrid/coarse_factor.h"
#include "weft/cloth/multigrid/filter_level.h"
#include "weft/core/thread_team.h"

namespace weft {

/// The paper's filter W = (I - (h^2 / m) H)^-1 made exact: a V-cycle over the image's own mip
/// pyramid applies A^-1 with A = M / h^2 + sum k (edge Laplacian), so W = A^-1 M / h^2, in O(N)
/// [zink07, section 4; brandt77]. A bounds the Hessian of implicit Euler's energy from above, so
/// x - A^-1 gradient never rises in energy.
///
/// The coarsest level, of at most 9 samples a side or the size that no longer halves, is solved
/// directly. Smoothing is Jacobi's with the Chebyshev roots of the upper part of the spectrum, the
/// same forwards before and backwards after the coarse correction, so that one cycle is a symmetric
/// operator and may precondition conjugate gradients.
class MultigridFilter {
 public:
  MultigridFilter(const Cloth& cloth, double time_step);

  /// To be called when particles have been pinned or let go.
  void renew_pins(const Cloth& cloth);
  [[nodiscard]] bool knows_pins(const Cloth& cloth) const;

  /// One V-cycle from zero: value() = about A^-1 right(). To be called by every worker of a team;
  /// ends with a barrier.
  void cycle(Worker& worker);

  /// Own part of the right side [N]; to be filled before a cycle.
  [[nodiscard]] Planes3& right() { return levels_.front().right; }
  /// The correction [m]; mates equal, 0 where held.
  [[nodiscard]] const Planes3& value() const { return levels_.front().value; }
  /// [n x n] own part of M / h^2 [N/m]
  [[nodiscard]] const Grid<float>& mass_weight() const { return levels_.front().own_weight; }

 private:
  void descend(std::size_t index, Worker& worker);
  void sweep(FilterLevel& level, float factor, Worker& worker);
  void first_sweep(FilterLevel& level, float factor, Worker& worker);
  void finish_sweep(FilterLevel& level, float factor, Worker& worker);
  void restrict_residual(FilterLevel& fine, FilterLevel& coarse, Worker& worker);
  void prolong(const FilterLevel& coarse, FilterLevel& fine, Worker& worker);
  void solve_coarsest(FilterLevel& level, Worker& worker);

  std::vector<FilterLevel> levels_;
  Grid<float> moves_;
  CoarseFactor factor_;  // of the coarsest level
};

}  // namespace weft
