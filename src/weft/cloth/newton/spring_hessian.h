#pragma once

#include <array>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/newton_kernels.h"
#include "weft/cloth/newton/padded_planes.h"
#include "weft/cloth/strain_stiffening.h"

namespace weft {

/// Positions and velocities of a step, and its start positions, in padded planes. [m], [m/s]
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

  /// Linearises the springs that start from a row. The transverse stiffness of a spring is its
  /// tension at the start of the step, or a part of its tension at the positions if that is more. A
  /// guess extrapolates along straight lines, which lengthens the springs of rotating cloth: their
  /// full tension there would hold light, stiff cloth back. Without any of it, impacts are
  /// linearised too softly.
  /// @param guessed_share  that part
  void linearise_row(const PaddedState& state, float guessed_share, int row);
  /// The energy of the springs that start from a row [J].
  [[nodiscard]] double energy_row(const PaddedVectors& position, int row) const;
  /// The same plus half of what damping dissipates in a step, which the step minimises [J].
  [[nodiscard]] double damped_energy_row(const PaddedState& state, int row) const;
  /// A row's own part of the gradient of inertia and springs, as linearised [N].
  /// @param wanted  velocities without internal forces [m/s]
  void gradient_row(const PaddedState& state, const PaddedVectors& wanted, int row,
                    PaddedVectors& out) const;
  void diagonal_row(int row, PaddedBlocks& out) const;
  /// The diagonal blocks of a row, and those without the line's own springs, see LineDiagonals.
  /// @param extra  [n] added to the latter
  void line_diagonals_row(int row, const float* extra, const LineDiagonals& out) const;
  /// State of a product that is computed row by row.
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
  [[nodiscard]] ConstSpringHessianRow springs_row(int direction, int row, int first_col = 0) const;
  /// The planes t, x, y, z of a direction, for temporary changes.
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
