#pragma once

#include <memory>
#include <span>
#include <vector>

#include "weft/cloth/baselines/contact_springs.h"
#include "weft/cloth/baselines/multigrid/multigrid_preconditioner.h"
#include "weft/cloth/bending.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/spring_rows.h"
#include "weft/core/ordered_sum.h"

namespace weft {

/// One step of implicit Euler with the springs as they are, by descending in its energy
///   E(x) = |x - y|^2_M / (2 h^2) + springs(x) + bending(x) + damping(x) + contacts(x),  y = x0 + h
///   v + h^2 g,
/// from x = y on: conjugate gradients [fletcher64], preconditioned by the multigrid filter, with a
/// secant step along each direction. The gradient at the step's end is taken as linear between
/// those at both ends of the secant, so an iteration costs one V-cycle and one pass over the
/// springs. Starting from y keeps free fall exact and, unlike a guess from the step before, adds no
/// energy when few iterations are made.
class NonlinearPcg {
 public:
  /// @param cloth  kept by reference, as is the team
  NonlinearPcg(const Cloth& cloth, double time_step, ThreadTeam& team);

  /// Starts a step: next() falls freely.
  void begin(const StepInput& input, const ClothState& state);
  /// Descends, with points beyond contacts' half-spaces pushed back by springs.
  /// @param contacts  of samples of the cloth
  void run(std::span<const Contact> contacts, const MultigridOptions& options);

  /// The current iterate. The next run continues from it, also where the caller moved samples: a
  /// guess that was kept from passing through something is where the descent begins.
  [[nodiscard]] ClothState& next() { return next_; }
  /// Normal forces of the contacts of the last run, in their order, less the part that friction has
  /// used [N].
  [[nodiscard]] std::span<const float> contact_forces() const { return contacts_.forces(); }
  /// Iterations since begin.
  [[nodiscard]] int iterations() const { return iterations_; }
  /// Largest correction of the last iteration over the rest spacing.
  [[nodiscard]] double correction() const { return correction_; }
  /// The last correction of every sample over the rest spacing. @param sizes  [n x n]
  void last_corrections(Grid<float>& sizes) const;

 private:
  /// State of a descent between iterations; every worker has its own, all alike.
  struct SolverState {
    double slope = 0;        ///< residual . filtered residual [N m]
    double left = 0;         ///< residual . direction after the step [N m]
    double step_length = 0;  ///< of the last step along its direction
    double correction = 0;
    int iterations = 0;
    bool exact = true;  ///< whether the residual was computed, not interpolated
  };
  void renew_filter();
  void hold_pins();
  /// Computes a row of y, the first guess, and sets z = d = 0.
  void fall_row(int row);
  void place_row(float step_length, int row);
  /// z += step_length d; d = 0.
  void accept_row(float step_length, int row);
  /// Sets z = x - y where the caller moved a sample.
  void update_moved_row(int row);
  /// Computes minus the gradient at `next`, forces less inertia. Ends with a barrier.
  /// @return its dot product with d [N m]
  double evaluate_gradient(Worker& worker);
  /// Ends with a barrier.
  void update_residual(SolverState& solver_state, Worker& worker);
  /// d = filtered residual + beta d, which keeps d conjugate; next = y + z + d. Ends with a
  /// barrier.
  /// @return the slope along d [N m]
  double update_direction(SolverState& solver_state, Worker& worker);
  /// Sets the step length along d at which the slope would vanish if it were linear.
  void advance(double slope, SolverState& solver_state, Worker& worker);
  [[nodiscard]] double largest_direction() const;
  /// Computes the residual at the current iterate and drops the direction.
  /// @return whether any contact changed
  bool restart(SolverState& solver_state, Worker& worker);
  /// Updates which contacts are active at `next` and which of them stick, and the filter's contact
  /// terms. Ends with a barrier. @return whether that changed
  bool update_contacts(Worker& worker);
  SolverState descend(const MultigridOptions& options, Worker& worker);

  const Cloth& cloth_;
  ThreadTeam& team_;
  const KernelTable& kernels_;
  /// The filter of one time step; kept, since halved and doubled steps come back to the same few.
  struct TimedFilter {
    double time_step;  // [s]
    std::unique_ptr<MultigridPreconditioner> filter;
  };
  std::vector<TimedFilter> filters_;  // the one in use first
  MultigridPreconditioner* filter_;
  ContactSprings contacts_;
  SpringRows springs_;
  BendingPass bending_;
  StepInput input_;
  ClothState start_, next_;
  Planes3 fall_, move_, direction_;  // y, z, d [m]
  Planes3 far_residual_;             // minus the gradient where `next` is [N]
  RowSums sums_;
  std::vector<float> largest_;      // [n] squared direction of each row [m^2]
  double pending_step_length_ = 0;  // along d, not yet in z
  int iterations_ = 0;
  double correction_ = 0;
};

}  // namespace weft
