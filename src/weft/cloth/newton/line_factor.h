#pragma once

#include <cstddef>
#include <memory>
#include <new>

#include "weft/cloth/kernels/newton_kernels.h"
#include "weft/cloth/newton/padded_planes.h"

namespace weft {

/// Factors of the lines of an n x n grid in one direction, in blocks that are solved side by side.
class LineFactor {
 public:
  /// @param held  whether the matrices are HeldLineMatrix, else LineMatrix
  LineFactor(int size, bool along_rows, bool held);

  [[nodiscard]] int blocks() const { return (size_ + line_lanes - 1) / line_lanes; }
  /// Factors a block of lines.
  void factor(int block, const LineMatrix& matrix, const NewtonKernels& kernels);
  void factor(int block, const HeldLineMatrix& matrix, const NewtonKernels& kernels);
  /// out = (add ? out : 0) + scale * solution of a block of lines.
  struct Solve {
    float scale = 1;
    bool add = false;
  };
  void solve(int block, const PaddedVectors& rhs, Solve how, float* scratch, PaddedVectors& out,
             const NewtonKernels& kernels) const;
  /// Floats of scratch that solve needs.
  [[nodiscard]] static std::size_t scratch_size(int size) {
    return static_cast<std::size_t>(size) * 3 * line_lanes;
  }

 private:
  [[nodiscard]] LineBlock at(int block) const;
  [[nodiscard]] float* factor_of(int block) const;
  [[nodiscard]] int entries() const { return held_ ? held_factor_entries : line_factor_entries; }
  struct Free {
    void operator()(float* p) const { ::operator delete (p, std::align_val_t{64}); }
  };

  int size_;
  bool along_rows_, held_;
  std::unique_ptr<float[], Free> factors_;
};

}  // namespace weft
