#pragma once

#include <limits>
#include <vector>

#include "weft/cloth/newton/bending_stencil.h"
#include "weft/cloth/newton/line_factor.h"
#include "weft/cloth/newton/padded_planes.h"
#include "weft/cloth/newton/seam_mismatch.h"
#include "weft/cloth/newton/seams.h"
#include "weft/cloth/newton/short_ends.h"
#include "weft/cloth/newton/spring_hessian.h"

namespace weft {

/// Diagonal entry that fixes a sample in a line's matrix: its inverse block is exactly zero. A
/// large number would leave denormal ones, with which processors are slow. [N/m]
inline constexpr float holding_stiffness = std::numeric_limits<float>::infinity();

/// Factor on the bending diagonal in the line smoother, which leaves out the rest of the bending
/// stencil. It makes relaxation contract at the same damping as for springs: the largest eigenvalue
/// of a biharmonic stencil is 3.2 times its diagonal, that of springs twice.
inline constexpr float bending_share = 1.6F;

/// A level of the multigrid preconditioner.
struct BlockLevel {
  LevelLayout layout;
  int size = 0;
  Seams seams;
  ShortEnds short_ends;   ///< beside the next finer level; none where the cloth has no seams
  SeamMismatch mismatch;  ///< of coarse levels
  BendingStencil bending;
  PaddedPlane extra;  ///< added to diagonals for the smoother [N/m]
  /// Nine-point stencils of 3 x 3 blocks: own parts, each sample's centre and the blocks to the
  /// four neighbours after it, as stencil_blocks. On the finest level the centre alone.
  PlaneSet stencil;
  /// On the finest level: the lines' diagonal blocks without the line's own springs.
  PlaneSet held_rows, held_cols;
  LineFactor rows, cols;
  PaddedVectors rhs, value, residual;
  PaddedVectors curved;                ///< bending's u; scratch
  std::vector<PaddedVectors> windows;  ///< three rows of u for each worker
  /// Largest diagonal entry of bending over the mass of its particle [1/s^2].
  double bending_rate = 0;
  bool bends = true;  ///< whether products of the cycle include bending
  /// A pinned sample; on coarse levels a node at one, or one of those around one that has none.
  /// There it is held only where bending counts: what is interpolated from it would have a kink at
  /// the pin, whose energy the level does not know.
  struct Pin {
    int sample = 0;
    float extra = 0;  ///< of the sample where it is not held
  };
  std::vector<Pin> pins;        ///< all copies
  std::vector<int> pin_starts;  ///< [size + 1] first of each row, in pins
  bool holds_pins = false;

  struct Shape {
    LevelLayout layout;
    bool finest;
    int workers;
  };
  BlockLevel(Shape shape, Seams seam_classes, BendingStencil stiffness);
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
  template <class CoarsenColumns>
  void coarsen_rows(const BlockLevel& fine, BlockLevel& coarse, const Workers& workers,
                    const NewtonKernels& kernels, const CoarsenColumns& coarsen_columns);
  /// A chart on two levels.
  struct Charts {
    const Chart &fine, &coarse;
  };
  template <class CoarsenColumns>
  static void coarsen_chart(const Charts& charts, Range rows, PlaneSet& half, BlockLevel& coarse,
                            const NewtonKernels& kernels, const CoarsenColumns& coarsen_columns);

  std::vector<PlaneSet> half_rows_;  // three half-coarsened rows for each worker
};

}  // namespace weft
