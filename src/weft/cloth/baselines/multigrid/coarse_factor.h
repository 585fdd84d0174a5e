#pragma once

#include <vector>

#include "weft/cloth/baselines/multigrid/preconditioner_level.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Direct solver of the coarsest level: a Cholesky factor within the envelope of A, to which its
/// fill-in is confined [george81]. Unknowns are ordered by image rows with mates as one unknown, so
/// an n x n sheet takes about n^3 entries, and a seam adds one long row for each of its particles.
class CoarseFactor {
 public:
  CoarseFactor() = default;
  /// Finds the envelope. @param level  gives edges and mates; its weights may change later
  explicit CoarseFactor(const FilterLevel& level);

  /// False where the envelope would be too large to be worth it (images of even size above about
  /// 128, which no halving shrinks).
  [[nodiscard]] bool fits() const { return !rows_.empty(); }
  /// Factors anew, in doubles. Requires fits().
  void renew(const FilterLevel& level);
  /// level.result = A^-1 level.rhs, by one worker.
  void solve(FilterLevel& level, const KernelTable& kernels);

 private:
  /// The entries of a row: columns `first` .. the diagonal, from `start` in the factor.
  struct Row {
    std::size_t start = 0;
    int first = 0;
  };
  void assemble(const FilterLevel& level);
  void factor();
  void place_runs();

  std::vector<int> unknown_of_;  // [n n] by sample
  std::vector<int> sample_of_;   // by unknown: its least sample
  std::vector<Row> rows_;
  std::vector<double> exact_;  // the lower factor, row by row
  // The same, rounded, as an Envelope.
  std::vector<float> by_rows_, by_columns_, inverse_diagonal_;
  std::vector<std::ptrdiff_t> row_start_, column_start_;
  Grid<float> work_;  // [3 x unknowns and their padding]
};

}  // namespace weft
