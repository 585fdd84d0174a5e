#pragma once

#include "weft/cloth/bending_normals.h"
#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Row and column offset of a neighbour in the bending stencil; opposite offsets come in pairs.
struct BendingOffset {
  int down = 0, right = 0;
};
inline constexpr std::array<BendingOffset, bending_neighbours> bending_offsets{
    {{0, 1}, {0, -1}, {1, 0}, {-1, 0}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};

/// Bending forces, minus the gradient of |u|^2 / 2 with u = M x - sqrt(B area) H0 n [bergou06], in
/// two passes over the rows: the first computes u, the second applies the transposed derivative of
/// u. Each sample gathers in both. The derivative of the forces is approximated by
/// -(du/dx)^T du/dx, which is exact for cloth that is flat at rest and gives no force for rotations
/// of the rest shape.
class BendingPass {
 public:
  /// @param cloth  kept by reference
  explicit BendingPass(const Cloth& cloth, InstructionSet instructions = best_instruction_set());

  /// Whether the cloth resists bending at all. If not, the other functions do nothing and contain
  /// no barrier.
  [[nodiscard]] bool active() const { return cloth_.bending.active; }

  /// Computes u of the positions, which are kept by reference until the rows are added. To be
  /// called by every worker when all positions are in place; ends with a barrier. Rows of the last
  /// call must not be in use any more.
  /// @param position  [n x n] [m]
  void curve(const Planes3& position, Worker& worker);
  /// Computes the linear change of u for a change of the positions of the last curve(), which must
  /// still be valid and unchanged.
  void curve_change(const Planes3& change, Worker& worker);
  /// Adds -factor (du/dx)^T u and the free-border term to each sample's own part of a row. Factor 1
  /// gives the bending forces [N]; after curve_change, factor -h^2 gives h^2 times the bending
  /// matrix times the change.
  void add_row(float factor, int row, Planes3& out) const;
  /// The energy of the last curve, over all particles [J].
  [[nodiscard]] double energy() const;
  /// The contribution of one row to energy() [J].
  [[nodiscard]] double row_energy(int row) const;

 private:
  /// Computes M field, summed over mates. Ends with a barrier.
  void gather(const Planes3& field, Worker& worker);
  void curve_row(const Planes3& position, int row);
  void add_border_row(float factor, int row, Planes3& out) const;

  const Cloth& cloth_;
  const KernelTable* kernels_;
  const Planes3* field_ = nullptr;  // field of the last curve or curve_change
  Planes3 curved_;                  // u
  BendingNormals normals_;
};

/// Conductances of the edges of one direction of stretch or shear whose Dirichlet energy bounds
/// that of bending from above,
///   |M x|^2 <= sum over edges k |x_j - x_i|^2,  k = sum over both ends (sum |weight|) |weight|,
/// laid out like the stiffnesses of a SpringPlane. The bound, by Cauchy and Schwarz, is tight for
/// the roughest fields; for smooth ones it is too large by the square of their wavelength in
/// samples. On the next coarser level it is scaled by a quarter. Zero planes for the directions of
/// bend springs.
/// @return [n x n] each sample's own part [N/m]
Grid<float> bending_bound(const Cloth& cloth, SpringDirection direction);

/// The energy of bending at a position [J].
double bending_energy(const Cloth& cloth, const Planes3& position);

}  // namespace weft
