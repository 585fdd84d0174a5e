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

/// What rows of a product or gradient pass on while they are computed one after another, from any
/// row on.
class RowSweep {
 public:
  explicit RowSweep(int cols)
      : carried_(3, cols), springs_(1, cols, near_directions * spring_entries) {}
  /// Begins another product.
  void restart() { next_ = -1; }
  /// Whether the row above was the last one.
  [[nodiscard]] bool goes_on_at(int row) const { return next_ == row; }
  /// Begins at a row to which nothing is passed.
  void start(int row);
  /// @param row  the next one
  [[nodiscard]] Passing passing(int row);
  /// Computes a row by product(row, rhs, out). Where the row above belongs to another worker it is
  /// computed again first, for what it passes on.
  /// @param rhs  null: none
  template <class Product>
  void multiply(int row, const PaddedVectors* rhs, Row3 out, const Product& product) {
    if (!goes_on_at(row)) {
      start(row > 0 ? row - 1 : 0);
      if (row > 0) product(row - 1, ConstRow3{}, scratch());
    }
    product(row, rhs != nullptr ? rhs->row(row) : ConstRow3{}, out);
  }
  // Rows of scratch.
  [[nodiscard]] Row3 scratch() { return carried_.row(2); }
  [[nodiscard]] MutablePlaneRows spring_scratch() { return rows_of(springs_, 0); }

 private:
  PaddedVectors carried_;  // forces on the next row, in turn, and scratch [N]
  PlaneSet springs_;
  int next_ = -1;
};

/// Springs linearised at a state: the Hessian of each is t 1 + s s^T with
/// t = k max(0, 1 - l0 / l) across the spring and t + |s|^2 = k along it, the positive part of the
/// true one; damping of the relative motion along springs adds its rate over h along them.
class SpringHessian {
 public:
  /// @param cloth  kept by reference
  SpringHessian(const Cloth& cloth, const NewtonKernels& kernels);

  void set_time_step(double time_step);
  [[nodiscard]] double time_step() const { return time_step_; }

  /// Where springs are linearised.
  struct Point {
    const PaddedState& at;
    const Planes3& start_velocity;  ///< v0 [m/s]
    Vec3f gained;                   ///< h g [m/s]
    /// Least transverse stiffness of a spring over its tension at the positions.
    float guessed_share;
  };
  /// Linearises the springs that start from a row, and computes its own part of the forces of
  /// springs and inertia. The transverse stiffness of a spring is its tension at the start of the
  /// step, or a part of its tension at the positions if that is more. A guess extrapolates along
  /// straight lines, which lengthens the springs of rotating cloth: their full tension there would
  /// hold light, stiff cloth back. Without any of it, impacts are linearised too softly. Rows in
  /// ascending order, none left out. @param sweep  restarted before the first
  void linearise_row(const Point& point, int row, RowSweep& sweep, PaddedVectors& force);
  /// Whether there are second-neighbour springs, whose forces are still to be added.
  [[nodiscard]] bool has_far() const { return directions_ > near_directions; }
  void add_far_forces(const PaddedVectors& position, int row, PaddedVectors& force) const;
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
  template <class Visit>
  void for_far_springs(int row, const Visit& visit) const;
  [[nodiscard]] NearSprings near_at(const PaddedState& state, int row) const;
  [[nodiscard]] LinearisedSprings far_at(int direction, const PaddedVectors& position,
                                         int row) const;
  [[nodiscard]] double far_energy_row(const PaddedVectors& position, int row) const;
  void linearise_far_row(const Point& point, int row);

  const Cloth& cloth_;
  const NewtonKernels* kernels_;
  double time_step_ = 0;
  int directions_;      // with or without second neighbours
  PlaneSet constants_;  // rest length, stiffness and damping of each near direction
  PlaneSet near_;
  std::array<Direction, spring_directions - near_directions> far_;
  PaddedPlane inertia_, momentum_;  // own parts of M / h^2, M / h
};

}  // namespace weft
