#pragma once

#include <array>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/newton_kernels.h"
#include "weft/cloth/newton/padded_planes.h"

namespace weft {

/// Beyond the material's strain limit stretch springs have this times their stiffness besides.
inline constexpr float strain_limit_factor = 10;

/// Positions and velocities of a step, with their frames. [m], [m/s]
struct PaddedState {
  PaddedVectors position, velocity, start;
  explicit PaddedState(int n) : position(n, n), velocity(n, n), start(n, n) {}
};

/// Springs linearised at a state: the Hessian of each is t 1 + s s^T with
/// t = k max(0, 1 - l0 / l) across the spring and t + |s|^2 = k along it, the positive part of the
/// true one; damping of the relative motion along springs adds its rate over h along them.
/// Rows are independent of one another.
class SpringHessian {
 public:
  /// @param cloth  kept by reference
  SpringHessian(const Cloth& cloth, const NewtonKernels& kernels);

  void set_time_step(double time_step);

  /// Linearises the springs that start from a row. Across itself a spring is as stiff as its
  /// tension was when the step began, or as a part of that at the positions, whichever is more: a
  /// guess goes straight on where cloth turns, which lengthens springs that are not, and their
  /// whole tension there holds light, stiff cloth back; without any of it impacts are linearised
  /// too softly.
  /// @param guessed_share  that part
  void linearise_row(const PaddedState& state, float guessed_share, int row);
  /// The energy of the springs that start from a row [J].
  [[nodiscard]] double energy_row(const PaddedVectors& position, int row) const;
  /// And what damping takes from them in a step, half of it: what a step minimises [J].
  [[nodiscard]] double damped_energy_row(const PaddedState& state, int row) const;
  /// The gradient of inertia and springs of a row's own part [N], where linearised.
  /// @param wanted  velocities without inner forces [m/s]
  void gradient_row(const PaddedState& state, const PaddedVectors& wanted, int row,
                    PaddedVectors& out) const;
  void diagonal_row(int row, PaddedBlocks& out) const;
  /// And what holds lines besides their own springs. @param extra  [n] added to that
  void line_diagonals_row(int row, const float* extra, const LineDiagonals& out) const;
  /// Rows of a product as they are worked through.
  struct Sweep {
    const PaddedVectors& x;
    PaddedVectors& scratch;  ///< [sweep_rows x n]
    bool started = false;
  };
  static constexpr int sweep_rows = 6;
  /// out = (M / h^2 + springs) x, own part. Rows of a sweep in ascending order, none left out.
  void apply_row(Sweep& sweep, int row, PaddedVectors& out) const;

  /// Own part of M / h^2 [N/m].
  [[nodiscard]] const PaddedPlane& inertia() const { return inertia_; }
  /// The springs of a direction that start from a row.
  [[nodiscard]] ConstSpringHessianRow springs_row(int direction, int row) const;
  /// The planes t, x, y, z of a direction, for those who change them for a while.
  [[nodiscard]] std::array<PaddedPlane*, 4> planes(int direction);
  /// Views of t, x, y, z of a direction.
  [[nodiscard]] std::array<PlaneView, 4> views(int direction) const;

 private:
  static constexpr int near_directions = 4;
  struct Direction {
    PaddedPlane t, x, y, z, f;
  };
  template <class Visit>
  void for_far_springs(int row, const Visit& visit) const;
  [[nodiscard]] LinearisedSprings springs_at(int direction, const PaddedVectors& position,
                                             int row) const;
  [[nodiscard]] SpringRing ring_at(int row) const;
  void sweep_row(const Sweep& sweep, int row, Row3 out) const;

  const Cloth& cloth_;
  const NewtonKernels* kernels_;
  double time_step_ = 0;
  int directions_;  // with or without second neighbours
  std::array<Direction, spring_directions> springs_;
  PaddedPlane inertia_, momentum_;  // own parts of M / h^2, M / h
};

}  // namespace weft
