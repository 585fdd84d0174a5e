#pragma once

#include <vector>

#include "weft/cloth/newton/block_level.h"
#include "weft/cloth/newton/spring_hessian.h"
#include "weft/cloth/newton/workers.h"

namespace weft {

/// The coarse stencils P^T A P of bilinear interpolation P, which stay nine-point stencils. Rows of
/// blocks in between are kept a few at a time, so that each stencil is read once.
class Galerkin {
 public:
  /// @param size  of the finest level  @param workers  how many may call at once
  Galerkin(int size, int workers);

  /// Coarse rows of the finest level, whose blocks are springs'. Samples that do not move (mask 0)
  /// have no part in it; the level's centres are 0 there.
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
  void coarsen_rows(int fine_size, BlockLevel& coarse, const Workers& workers,
                    const NewtonKernels& kernels, const FineRow& fine_row);

  std::vector<Scratch> scratch_;  // of each worker
};

}  // namespace weft
