#pragma once

#include <algorithm>
#include <array>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/implicit_kernels.h"
#include "weft/cloth/neighbours.h"
#include "weft/core/instruction_set.h"

namespace weft {

/// Forces of all springs on the particles of one row: each sample gathers from its neighbours, so
/// no write is shared between rows. A sample of a class gets its own part; the class's force is the
/// sum over it. With l = x_j - x_i the force on i is k (|l| - r) l / |l| [provot95; the sign there
/// is a slip].
class SpringForces {
 public:
  /// @param cloth  kept by reference
  explicit SpringForces(const Cloth& cloth, InstructionSet instructions = best_instruction_set());

  /// Elastic forces alone.
  /// @param position  [n x n] [m]
  /// @param force     [n x n] row `row` is overwritten [N]
  void gather_elastic(int row, const Planes3& position, Planes3& force) const;

  /// Elastic forces and damping: c times the relative velocity along the spring, so that neither
  /// free fall nor turning as a whole is slowed.
  void gather_damped(int row, const ClothState& state, Planes3& force) const;

 private:
  const Cloth& cloth_;
  const ImplicitKernels& kernels_;
};

/// The stiffness of springs whose ratio to the masses they join is the same everywhere: `per_mass`
/// times the harmonic mean of both masses. On equal particles that is one stiffness for all, as the
/// paper has it; on uneven cells it keeps h^2 k / m, and with it stability, alike for small and
/// large particles. Springs along the border have half: on a seam both mates hold them, on an edge
/// they stand for half a strip.
/// @param mass_at  mass of the particle at (row, col) [kg]
/// @param out      [n x n] the spring from (r, c) on [N/m]
template <class MassAt, class T>
void mass_springs(SpringOffset offset, double per_mass, const MassAt& mass_at, Grid<T>& out) {
  const int n = out.rows();
  const auto [down, right] = offset;
  for (int r = 0; r + down < n; ++r)
    for (int c = std::max(0, -right); c + std::max(0, right) < n; ++c) {
      const double a = mass_at(r, c), b = mass_at(r + down, c + right);
      const bool along =
          (down == 0 && (r == 0 || r == n - 1)) || (right == 0 && (c == 0 || c == n - 1));
      out(r, c) = static_cast<T>((along ? 0.5 : 1.0) * per_mass * 2 * a * b / (a + b));
    }
}

struct NeighbourRow;

/// A symmetric 3 x 3 matrix a sample, upper triangle: xx, xy, xz, yy, yz, zz.
using Blocks = std::array<Grid<float>, 6>;

inline BlockRow row_of(const Blocks& blocks, int r) {
  return {blocks[0].row(r), blocks[1].row(r), blocks[2].row(r),
          blocks[3].row(r), blocks[4].row(r), blocks[5].row(r)};
}
inline BlockRowOut row_of(Blocks& blocks, int r) {
  return {blocks[0].row(r), blocks[1].row(r), blocks[2].row(r),
          blocks[3].row(r), blocks[4].row(r), blocks[5].row(r)};
}

/// S = h^2 K + h C, the part of implicit Euler's matrix that springs make: K the stiffness matrix
/// with its transverse part held non-negative, C the damping along the springs. For one spring of
/// direction d, length l and rest r the block between its ends is a 1 + s s^T with
///   a = h^2 k max(0, 1 - r / l),  a + |s|^2 = h^2 k + h c,  s along d.
/// Stored as four planes a direction. Rows are computed apart; a sample of a class gets its own
/// part.
class SpringMatrix {
 public:
  /// @param cloth  kept by reference
  explicit SpringMatrix(const Cloth& cloth, InstructionSet instructions = best_instruction_set());

  /// Computes the springs that start in a row. All rows must be done before the next functions are
  /// used.
  void linearise_row(const Planes3& position, double time_step, int row);
  /// Row `row` of out = S in. [in: m/s, out: kg m/s]
  void multiply_row(const Planes3& in, Planes3& out, int row) const;
  /// Adds the diagonal blocks of S to a row of blocks.
  void add_diagonal_row(Blocks& blocks, int row) const;

 private:
  struct Direction {
    Grid<float> transverse;  ///< a
    Planes3 axial;           ///< s
  };
  [[nodiscard]] NeighbourBlocks blocks_of(const NeighbourRow& to) const;

  const Cloth& cloth_;
  const ImplicitKernels& kernels_;
  std::array<Direction, spring_directions> directions_;
};

}  // namespace weft
