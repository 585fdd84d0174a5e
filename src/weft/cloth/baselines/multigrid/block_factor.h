#pragma once

#include <vector>

#include "weft/cloth/baselines/multigrid/preconditioner_level.h"

namespace weft {

/// Direct solver of a coarsest level with contacts, which couple the coordinates: a dense Cholesky
/// factor, for levels of few particles.
class BlockFactor {
 public:
  BlockFactor() = default;
  explicit BlockFactor(const FilterLevel& level);

  /// False where there are too many particles.
  [[nodiscard]] bool fits() const { return !sample_of_.empty(); }
  /// Factors anew. Requires fits(). Allocates nothing.
  void renew(const FilterLevel& level);
  /// level.result = A^-1 level.rhs.
  void solve(FilterLevel& level);

 private:
  [[nodiscard]] double& entry(int row, int col) {
    return matrix_[static_cast<std::size_t>(row) * count_ + col];
  }
  void assemble(const FilterLevel& level);
  void add_edge(int i, int j, double k);
  void factor();

  std::vector<int> unknown_of_;  // [n n] particle by sample
  std::vector<int> sample_of_;   // by particle
  int count_ = 0;                // rows: three a particle
  std::vector<double> matrix_;   // [count x count], its lower half
  std::vector<double> x_;
};

}  // namespace weft
