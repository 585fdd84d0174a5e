#pragma once

#include <vector>

#include "weft/cloth/baselines/multigrid/block_factor.h"
#include "weft/cloth/baselines/multigrid/coarse_factor.h"
#include "weft/cloth/baselines/multigrid/preconditioner_level.h"
#include "weft/core/ordered_sum.h"
#include "weft/core/thread_team.h"

namespace weft {

/// The paper's filter W = (I - (h^2 / m) H)^-1 made exact: a V-cycle over the image's own mip
/// pyramid applies A^-1 with A = M / h^2 + sum k (edge Laplacian), so W = A^-1 M / h^2, in O(N)
/// [zink07, section 4; brandt77]. A bounds the Hessian of implicit Euler's energy from above, so
/// x - A^-1 gradient never rises in energy.
///
/// The smoother is Jacobi's, damped by Chebyshev's roots, in the opposite order after the coarse
/// correction. With one sweep before and after, of which the first starts from zero and needs no
/// neighbours, a cycle on a uniform sheet leaves 0.26 of the error, with two of each 0.15 for twice
/// the work: one is enough for few iterations. The coarsest level, of at most 5 samples a side or
/// the size that no longer halves, is solved directly. A cycle is a symmetric operator and may
/// precondition conjugate gradients.
class MultigridPreconditioner {
 public:
  struct Options {
    double time_step = 1.0 / 240;  ///< [s]
    int sweeps = 1;                ///< before and after the coarse correction, 1 or 2
  };
  /// @param team  that will call cycle
  MultigridPreconditioner(const Cloth& cloth, const Options& options, const ThreadTeam& team);

  /// Updates the operator after particles have been pinned or released.
  void renew_pins(const Cloth& cloth);
  [[nodiscard]] bool knows_pins(const Cloth& cloth) const;

  /// Updates the contacts' terms on all levels. To be called by every worker of the team; ends with
  /// a barrier.
  void renew_contacts(const ContactLoads& contacts, Worker& worker);

  /// One V-cycle from zero: value() approximates A^-1 rhs(). To be called by every worker of the
  /// team; ends with a barrier. @return rhs . value [N m]
  double cycle(Worker& worker);

  /// The right side, mates equal [N]; to be filled before a cycle.
  [[nodiscard]] Planes3& rhs() { return levels_.front().rhs; }
  /// The correction [m]; mates equal, 0 where held.
  [[nodiscard]] const Planes3& value() const { return levels_.front().result; }

  /// [n x n] own part of M / h^2 [N/m]
  [[nodiscard]] const Grid<float>& mass_weight() const { return levels_.front().own_weight; }
  /// Level 0: its operator, diagonals and shares.
  [[nodiscard]] const FilterLevel& finest() const { return levels_.front(); }

 private:
  struct Workers;
  void below(std::size_t index, Worker& worker);
  void down(FilterLevel& fine, FilterLevel& coarse, const Workers& workers);
  void up(const FilterLevel& coarse, FilterLevel& fine, const Workers& workers);
  void first_sweep_row(const FilterLevel& level, int row, Row3 out) const;
  void apply_row(const FilterLevel& level, int row, const StencilRows& x, Row3 out) const;
  double contact_sweep_row(const FilterLevel& level, int row, const SweepRow& sweep,
                           Row3 out) const;
  void lone_sweep_residual(FilterLevel& level, const Workers& workers);
  void two_sweeps_residual(FilterLevel& level, const Workers& workers);
  double sweep_row(FilterLevel& level, int row, float factor);
  double finest_sweep(Worker& worker);
  void level_sweep(FilterLevel& level, float factor, const Workers& workers);
  void exchange(FilterLevel& level, const Workers& workers);
  void solve_coarsest(FilterLevel& level, const Workers& workers);
  [[nodiscard]] Row3 lines(const Worker& worker, int index);

  std::vector<float> factors_;  // of the sweeps, in the order before the coarse correction
  std::vector<FilterLevel> levels_;
  Grid<float> moves_;
  std::vector<int> pinned_;   // samples
  CoarseFactor factor_;       // of the coarsest level
  BlockFactor block_factor_;  // of the coarsest level with contacts
  bool touching_ = false;     // whether there are contacts
  const KernelTable* kernels_;
  Grid<float> lines_;  // scratch of every worker
  RowSums sums_;
};

}  // namespace weft
