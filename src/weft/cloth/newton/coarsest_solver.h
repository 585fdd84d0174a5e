#pragma once

#include <vector>

#include "weft/cloth/newton/block_level.h"

namespace weft {

/// Direct solver of the coarsest level, of at most 3 x 3 samples: a dense L D L^T in double. Rank 0
/// alone calls.
class CoarsestSolver {
 public:
  static constexpr int max_size = 3;
  CoarsestSolver() = default;
  explicit CoarsestSolver(const BlockLevel& level);

  void factor(const BlockLevel& level) noexcept;
  /// level.value = A^-1 level.rhs, seam copies equal.
  void solve(BlockLevel& level) noexcept;

 private:
  void add_block(int from, int to, const PaddedBlocks& blocks, int row, int col);
  [[nodiscard]] double& at(int row, int col) {
    return matrix_[static_cast<std::size_t>(row) * unknowns_ + col];
  }

  int unknowns_ = 0;
  std::vector<int> node_;        // [n x n] node of each sample
  std::vector<double> bending_;  // [nodes x nodes] M^T M
  std::vector<double> matrix_;   // L below the diagonal, D on it
  std::vector<double> value_;
};

}  // namespace weft
