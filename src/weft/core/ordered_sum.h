#pragma once

#include <array>
#include <vector>

#include "weft/core/thread_team.h"

namespace weft {

/// The sum of term(0) .. term(count - 1) in eight fixed lanes, folded in a fixed order: the same
/// bits for every vector width. `term` returns double.
template <class Term>
double lane_sum(int count, const Term& term) {
  constexpr int lanes = 8;
  std::array<double, lanes> sums{};
  int i = 0;
  for (; i + lanes <= count; i += lanes)
    for (int lane = 0; lane < lanes; ++lane) sums[lane] += term(i + lane);
  for (int lane = 0; i < count; ++i, ++lane) sums[lane] += term(i);
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

/// A sum over the rows of a grid that any number of threads computes to the same bits: every row
/// has a slot of its own, the slots are added in row order. Usable many times inside one parallel
/// region.
class RowSums {
 public:
  explicit RowSums(int rows) : slots_{std::vector<double>(rows), std::vector<double>(rows)} {}

  /// To be called by every worker of the team; all get the same sum. row_sum(r) returns double.
  template <class RowSum>
  double sum(Worker& worker, const RowSum& row_sum) {
    if (worker.alone()) return lone_sum(row_sum);
    // Two sets of slots alternate, so that one barrier a sum is enough. Each worker has its own
    // counter.
    std::vector<double>& slots = slots_[turn_of(worker)];
    const int rows = static_cast<int>(slots.size());
    const Range mine = worker.share(rows);
    for (int r = mine.first; r < mine.last; ++r) slots[r] = row_sum(r);
    worker.barrier();
    double total = 0;
    for (int r = 0; r < rows; ++r) total += slots[r];
    return total;
  }

 private:
  /// The sum by a lone worker, in the same order. The alternation counters stay as they are, so
  /// that they remain equal among workers.
  template <class RowSum>
  double lone_sum(const RowSum& row_sum) const {
    double total = 0;
    for (int r = 0; r < static_cast<int>(slots_[0].size()); ++r) total += row_sum(r);
    return total;
  }
  static constexpr int max_workers = 256;
  struct alignas(64) Turn {
    unsigned value = 0;
  };
  unsigned turn_of(const Worker& worker) { return turns_[worker.rank()].value++ & 1U; }

  std::array<std::vector<double>, 2> slots_;
  std::vector<Turn> turns_ = std::vector<Turn>(max_workers);
};

}  // namespace weft
