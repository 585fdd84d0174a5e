#pragma once

#include <vector>

#include "weft/cloth/newton/block_level.h"

namespace weft {

/// Direct solver of the coarsest level, of charts of at most 3 x 3 samples: an L D L^T in double,
/// dense but for the zeros before the first entry of each row. Rank 0 alone calls.
class CoarsestSolver {
 public:
  static constexpr int max_size = 3;
  /// Particles beyond which solving directly would cost more than the levels above.
  static constexpr int max_nodes = 64;
  CoarsestSolver() = default;
  /// Not active where the level has more nodes.
  explicit CoarsestSolver(const BlockLevel& level);
  [[nodiscard]] bool active() const { return unknowns_ > 0; }

  void factor(const BlockLevel& level) noexcept;
  /// level.value = A^-1 level.rhs, seam copies equal.
  void solve(BlockLevel& level) noexcept;

 private:
  /// A node that a sample's value is a part of: its own, or of a hanging one those that it hangs
  /// from.
  struct Part {
    int node = 0;
    double weight = 1;
  };
  void number_nodes(const BlockLevel& level);
  void find_bending(const BlockLevel& level);
  /// Adds a block of the stencil of `sample` between two samples.
  void add_block(int from, int to, const PlaneSet& stencil, int block, int sample);
  void add_mismatch(const SeamMismatch& mismatch);
  /// Takes the held pins of a level out of the matrix.
  void hold_pins(const BlockLevel& level);
  [[nodiscard]] double& at(int row, int col) {
    return matrix_[static_cast<std::size_t>(row) * unknowns_ + col];
  }

  int unknowns_ = 0;
  std::vector<int> node_;                 // [n x n] node of each sample, -1 in no chart, or hanging
  std::vector<std::vector<Part>> parts_;  // [n x n] empty in no chart
  std::vector<int> first_;                // [unknowns] first column of each row that is not 0
  std::vector<double> bending_;           // [nodes x nodes] M^T M
  std::vector<double> matrix_;            // L below the diagonal, D on it
  std::vector<double> value_;
};

}  // namespace weft
