#pragma once

#include <array>

#include "weft/cloth/bending.h"
#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/newton_kernels.h"
#include "weft/cloth/newton/padded_planes.h"
#include "weft/cloth/newton/seams.h"
#include "weft/core/thread_team.h"

namespace weft {

/// The quadratic bending energy |M x|^2 / 2 as stencil weights of the eight neighbours. A coarser
/// level takes half the weights of every second sample: at twice the spacing, areas are four times
/// as large and second differences a quarter.
class BendingStencil {
 public:
  BendingStencil() = default;
  explicit BendingStencil(const BendingPlanes& bending);
  [[nodiscard]] BendingStencil coarsened(const LevelLayout& fine, const LevelLayout& coarse) const;

  [[nodiscard]] bool active() const { return neighbours_ > 0; }
  /// u = M x, own part of a row. @param row  from -1 to n
  void bend_row(const PaddedVectors& x, int row, const NewtonKernels& kernels, Row3 u) const;
  /// out += factor M^T u, own part of a row. @param u  around the row, summed over seam copies
  void unbend_row(const RowTriple& u, int row, float factor, const NewtonKernels& kernels,
                  Row3 out) const;
  /// The diagonal of M^T M, summed over seam copies. [N/m]
  [[nodiscard]] PaddedPlane diagonal(const Seams& seams) const;
  /// The weight of a neighbour of sample (row, col) in M.
  [[nodiscard]] float weight(int neighbour, int row, int col) const {
    return weights_(row, col, neighbour);
  }
  [[nodiscard]] int neighbours() const { return neighbours_; }

 private:
  int neighbours_ = 0;  // 0, 4 or 8
  PlaneSet weights_;    // of each neighbour
};

/// Bending of cloth with a curved rest shape: the exact gradient and the Gauss-Newton Hessian of
/// |M x - r n(x)|^2 / 2, whose normals n depend on x.
class CurvedBending {
 public:
  /// @param cloth  kept by reference
  CurvedBending(const Cloth& cloth, InstructionSet instructions);
  [[nodiscard]] bool active() const { return active_; }

  // To be called by every worker; each ends with a barrier.

  /// @param position  by reference until the last change()
  void set_position(const Planes3& position, Worker& worker);
  void change(const PaddedVectors& direction, Worker& worker);
  /// The energy at the last position, by rank 0 alone [J].
  [[nodiscard]] double energy() const { return pass_.energy(); }

  /// Adds factor times a row's own part of the gradient after set_position, of the Hessian's
  /// product after change.
  void add_row(float factor, int row, PaddedVectors& out);

 private:
  const Cloth& cloth_;
  bool active_;
  BendingPass pass_;
  Planes3 direction_, force_;
};

}  // namespace weft
