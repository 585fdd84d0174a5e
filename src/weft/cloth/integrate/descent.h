#pragma once

#include <span>
#include <vector>

#include "weft/cloth/integrate/contact_filter.h"
#include "weft/cloth/integrate/integrator.h"
#include "weft/cloth/multigrid/filter.h"
#include "weft/core/ordered_sum.h"

namespace weft {

/// One step of implicit Euler with the springs as they are, by descending in its energy
///   E(x) = |x - y|^2_M / (2 h^2) + springs(x) + damping(x),  y = x0 + h v + h^2 g,
/// from x = y on: conjugate gradients [polak69], preconditioned by the multigrid filter, with a
/// secant step along each direction. The gradient at the step's end is taken as linear between
/// those at both ends of the secant, so an iteration costs one V-cycle and one pass over the
/// springs. Starting from y keeps free fall exact and, unlike a guess from the step before, adds no
/// energy when few iterations are made.
class Descent {
 public:
  /// @param cloth  kept by reference
  Descent(const Cloth& cloth, double time_step);

  /// Starts a step: next() falls freely.
  void begin(const StepInput& input, const ClothState& state, ThreadTeam& team);
  /// Puts particles onto the contacts' surfaces and descends along them.
  void run(std::span<const Contact> contacts, const MultigridOptions& options, ThreadTeam& team);

  /// Where the descent stands. What the caller changes here decides which contacts the next run
  /// heeds; that goes on from where the last one ended.
  [[nodiscard]] ClothState& next() { return next_; }
  /// Iterations since begin.
  [[nodiscard]] int iterations() const { return iterations_; }
  /// The last iteration's largest correction over the rest spacing.
  [[nodiscard]] double correction() const { return correction_; }

 private:
  void renew_filter();
  void hold_pins();
  /// A row of y, the first guess, and z = 0.
  void fall_row(int row);
  /// next = y + z + way d, and the velocity that leads there.
  void place_row(float way, int row);
  /// Own part of minus the gradient at `next`: forces less inertia.
  void residual_row(float way, Planes3& out, int row);
  /// Fills next and the residual there. Ends with a barrier.
  void look(float way, Planes3& out, Worker& worker);
  /// d = what the filter makes of the residual, and of the last direction what keeps it conjugate.
  /// @param last_slope  what the last turn returned; 0: there was none
  /// @return residual . W residual [N m]
  double turn(double last_slope, Worker& worker);
  void turn_row(float beta, int row);
  void copy_right_row(int row);
  /// far = residual - right: what the last step changed in the residual.
  void step_difference_row(int row);
  /// Goes along d to where its slope would vanish if that fell linearly.
  /// @return the largest correction over the rest spacing
  double go(Worker& worker);
  /// z += way d, the residual moved along the secant.
  void step_row(float way, int row);
  void descend(const MultigridOptions& options, Worker& worker);

  const Cloth& cloth_;
  double time_step_;  // [s] that the filter was made for
  MultigridFilter filter_;
  ContactFilter contacts_;
  StepInput input_;
  ClothState start_, next_;
  Planes3 fall_, move_, direction_;  // y, z, d [m]
  Planes3 residual_, far_residual_;  // own parts [N]
  RowSums sums_;
  std::vector<float> largest_;  // [n] correction of each row [m]
  int iterations_ = 0;
  double correction_ = 0;
};

}  // namespace weft
