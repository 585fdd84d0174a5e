#pragma once

#include "bench/tight_energy.h"
#include "weft/cloth/newton/block_multigrid.h"
#include "weft/cloth/newton/spring_hessian.h"

namespace weft::bench {

struct TightOptions {
  double tolerance = 1e-7;    ///< of the largest move of a Newton step [m]
  double exact_below = 1e-4;  ///< with moves shorter than this the exact Hessian is tried first [m]
  double inner_tolerance = 1e-3;  ///< of the residual in the preconditioner's norm, over the first
  int max_newton = 100, max_inner = 300;
};

/// Steps of implicit Euler solved to the end: Newton's method with backtracking, conjugate
/// gradients in double inside. It shares with `newton` nothing but the V-cycle that preconditions
/// them, which changes how fast it comes to the solution, not the solution.
class TightSolver {
 public:
  /// @param cloth  kept by reference
  explicit TightSolver(const Cloth& cloth, const TightOptions& options = {});

  /// @return whether the tolerance was reached
  bool step(const StepInput& input, TightState& state);
  [[nodiscard]] const TightEnergy& energy() const { return energy_; }

 private:
  void precondition(const Field& residual, Field& out);
  void set_up_preconditioner(const Field& position);
  void find_step(const Field& position, double last_move);
  bool solve();
  double move(Field& position);

  const Cloth& cloth_;
  TightOptions options_;
  TightEnergy energy_;
  ThreadTeam team_{1};
  const NewtonKernels& kernels_;
  SpringHessian springs_;
  BlockMultigrid multigrid_;
  PaddedState state_;
  Planes3 still_;         // velocities
  PaddedVectors unused_;  // forces
  Field gradient_, step_, residual_, before_, direction_, product_, value_, trial_;
};

}  // namespace weft::bench
