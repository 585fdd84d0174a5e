#pragma once

#include <array>
#include <vector>

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

/// What rows of a product or gradient pass on while they are computed one after another, from any
/// row on.
class RowSweep {
 public:
  explicit RowSweep(int cols) : carried_(3, cols) {}
  /// Begins another product.
  void restart() { next_ = -1; }
  /// Whether the row above was the last one.
  [[nodiscard]] bool goes_on_at(int row) const { return next_ == row; }
  /// Begins at a row to which nothing is passed.
  void start(int row);
  /// @param row  the next one
  [[nodiscard]] Passing passing(int row);
  /// A row of scratch.
  [[nodiscard]] Row3 scratch() { return carried_.row(2); }

 private:
  PaddedVectors carried_;  // forces on the next row, in turn, and scratch [N]
  int next_ = -1;
};

/// Springs linearised at a state: the Hessian of each is t 1 + s s^T with
/// t = k max(0, 1 - l0 / l) across the spring and t + |s|^2 = k along it, the positive part of the
/// true one; damping of the relative motion along springs adds its rate over h along them.
class SpringHessian {
 public:
  /// @param cloth  kept by reference  @param workers  the largest number of callers at once
  SpringHessian(const Cloth& cloth, int workers, const NewtonKernels& kernels);

  void set_time_step(double time_step);
  [[nodiscard]] double time_step() const { return time_step_; }

  /// Linearises the springs that start from a worker's rows, and computes these rows' own part of
  /// the gradient of inertia and springs. The transverse stiffness of a spring is its tension at
  /// the start of the step, or a part of its tension at the positions if that is more. A guess
  /// extrapolates along straight lines, which lengthens the springs of rotating cloth: their full
  /// tension there would hold light, stiff cloth back. Without any of it, impacts are linearised
  /// too softly. Ends with a barrier.
  struct Linearised {
    const PaddedState& at;
    const PaddedVectors& wanted;  ///< velocities without internal forces [m/s]
    float guessed_share;          ///< that part
  };
  void linearise(const Linearised& state, PaddedVectors& gradient, Worker& worker);
  /// The energy of the springs that start from a row [J].
  [[nodiscard]] double energy_row(const PaddedVectors& position, int row) const;
  /// The same plus half of what damping dissipates in a step, which the step minimises [J].
  [[nodiscard]] double damped_energy_row(const PaddedState& state, int row) const;
  /// The diagonal blocks of a row, and those without the line's own springs, see LineDiagonals.
  /// @param extra  [n] added to the latter
  void line_diagonals_row(int row, const float* extra, const LineDiagonals& out) const;
  /// out = (M / h^2 + springs) x, own part, or what that leaves of rhs. Rows in ascending order,
  /// none left out. @param sweep  restarted before the first  @param rhs  null: none
  void apply_row(const PaddedVectors& x, int row, RowSweep& sweep, const PaddedVectors* rhs,
                 PaddedVectors& out) const;

  /// Own part of M / h^2 [N/m].
  [[nodiscard]] const PaddedPlane& inertia() const { return inertia_; }
  /// The near springs' t, x, y, z, of each direction in turn.
  [[nodiscard]] const PlaneSet& near() const { return near_; }
  [[nodiscard]] PlaneSet& near() { return near_; }
  /// Views of t, x, y, z of a near direction.
  [[nodiscard]] std::array<PlaneView, spring_entries> views(int direction) const;

 private:
  /// Springs to second neighbours.
  struct Direction {
    PaddedPlane t, x, y, z, f;
  };
  struct Scratch {
    RowSweep sweep;
    PlaneSet row;  // [1 x n] Hessians of a row that is another worker's
    explicit Scratch(int n) : sweep(n), row(1, n, near_directions * spring_entries) {}
  };
  template <class Visit>
  void for_far_springs(int row, const Visit& visit) const;
  [[nodiscard]] NearSprings near_at(const PaddedState& state, int row) const;
  [[nodiscard]] LinearisedSprings far_at(int direction, const PaddedVectors& position,
                                         int row) const;
  [[nodiscard]] double far_energy_row(const PaddedVectors& position, int row) const;
  void linearise_row(const Linearised& state, int row, Scratch& own, MutablePlaneRows hessian,
                     Row3 gradient) const;
  void linearise_far_row(const Linearised& state, int row);
  void add_far_gradient(const PaddedVectors& position, int row, PaddedVectors& gradient) const;

  const Cloth& cloth_;
  const NewtonKernels* kernels_;
  double time_step_ = 0;
  int directions_;      // with or without second neighbours
  PlaneSet constants_;  // rest length, stiffness and damping of each near direction
  PlaneSet near_;
  std::array<Direction, spring_directions - near_directions> far_;
  PaddedPlane inertia_, momentum_;  // own parts of M / h^2, M / h
  std::vector<Scratch> scratch_;    // of each worker
};

}  // namespace weft
