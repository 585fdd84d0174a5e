#pragma once

#include <vector>

#include "weft/cloth/newton/bending_stencil.h"
#include "weft/cloth/newton/line_factor.h"
#include "weft/cloth/newton/padded_planes.h"
#include "weft/cloth/newton/seams.h"
#include "weft/cloth/newton/spring_hessian.h"

namespace weft {

/// Diagonal entry that fixes a sample in a line's matrix. [N/m]
inline constexpr float holding_stiffness = 1e20F;

/// Factor on the bending diagonal in the line smoother, which leaves out the rest of the bending
/// stencil. It makes relaxation contract at the same damping as for springs: the largest eigenvalue
/// of a biharmonic stencil is 3.2 times its diagonal, that of springs twice.
inline constexpr float bending_share = 1.6F;

/// Nine-point stencils of 3 x 3 blocks: own parts, each sample's centre and the blocks to the four
/// neighbours after it.
struct BlockStencil {
  PaddedBlocks centre, right, below_left, below, below_right;

  BlockStencil() = default;
  explicit BlockStencil(int n)
      : centre(n, n), right(n, n), below_left(n, n), below(n, n), below_right(n, n) {}
};

/// A level of the multigrid preconditioner.
struct BlockLevel {
  LevelLayout layout;
  int size = 0;
  Seams seams;
  BendingStencil bending;
  PaddedPlane extra;     ///< added to diagonals for the smoother [N/m]
  BlockStencil stencil;  ///< on the finest level the centre only
  PaddedBlocks joined;   ///< the centres summed over seam copies; empty without seams
  /// On a finest level without seams: the lines' diagonal blocks without the line's own springs.
  PaddedBlocks held_rows, held_cols;
  LineFactor rows, cols;
  PaddedVectors rhs, value, residual;
  PaddedVectors curved;                ///< bending's u; scratch
  std::vector<PaddedVectors> windows;  ///< three rows of u for each worker

  struct Shape {
    LevelLayout layout;
    bool finest;
    int workers;
  };
  BlockLevel(Shape shape, Seams seam_classes, BendingStencil stiffness);
  /// The diagonal blocks that lines are factored with.
  [[nodiscard]] const PaddedBlocks& diagonal() const {
    return seams.empty() ? stencil.centre : joined;
  }
};

/// Computes the coarse stencils P^T A P of bilinear interpolation P, which stay nine-point
/// stencils. Half-coarsened rows of blocks are kept three at a time, so that each stencil is read
/// once.
class Galerkin {
 public:
  /// @param size  of the finest level  @param workers  the largest number of callers at once
  Galerkin(int size, int workers);

  /// Coarsens the finest level, whose blocks beside the centres are those of springs. Pinned
  /// samples (mask 0) have no part in it; the level's centres are 0 there.
  void coarsen(const SpringHessian& springs, const BlockLevel& fine, const PaddedPlane& mask,
               BlockLevel& coarse, const Workers& workers, const NewtonKernels& kernels);
  void coarsen(const BlockLevel& fine, BlockLevel& coarse, const Workers& workers,
               const NewtonKernels& kernels);

 private:
  /// The five rows of blocks of one row, with a frame.
  struct Rows {
    std::vector<float> values;
    StencilBlocks read{};
    MutableStencilBlocks write{};
    Rows() = default;
    explicit Rows(int cols);
  };
  struct Scratch {
    Rows fine;
    Rows half[3];
  };
  template <class FineRow>
  void coarsen_rows(const BlockLevel& fine, BlockLevel& coarse, const Workers& workers,
                    const NewtonKernels& kernels, const FineRow& fine_row);
  template <class FineRow>
  void coarsen_chart(std::size_t chart, const BlockLevel& fine, BlockLevel& coarse, Range rows,
                     Scratch& own, const NewtonKernels& kernels, const FineRow& fine_row);

  std::vector<Scratch> scratch_;  // of each worker
};

}  // namespace weft
