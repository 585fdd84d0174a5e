#include "weft/cloth/baselines/multigrid/coarse_factor.h"

#include <algorithm>
#include <cmath>

#include "weft/cloth/neighbours.h"
#include "weft/core/ordered_sum.h"

namespace weft {
namespace {

/// 32 MB of doubles; about 1 s to factor, 10 ms to apply.
constexpr std::size_t max_entries = 4'500'000;

/// Calls use(sample, other sample, conductance) for every edge of a level.
template <class Use>
void for_each_edge(const FilterLevel& level, const Use& use) {
  const int n = level.size();
  for (int d = 0; d < bend_u; ++d) {
    const Grid<float>& edges = level.edge[d];
    const auto [down, right] = spring_offsets[d];
    for (int r = 0; r + down < n; ++r)
      for (int c = std::max(0, -right); c + std::max(0, right) < n; ++c)
        use(r * n + c, (r + down) * n + c + right, edges(r, c));
  }
}

}  // namespace

CoarseFactor::CoarseFactor(const FilterLevel& level) {
  const int n = level.size();
  std::vector<int> min(static_cast<std::size_t>(n) * n);
  for (int s = 0; s < n * n; ++s) min[s] = s;
  for (int index = 0; index < level.mates.class_count(); ++index)
    for (const int s : level.mates.mates(index)) min[s] = level.mates.mates(index).front();
  unknown_of_.resize(min.size());
  for (int s = 0; s < n * n; ++s) {
    if (min[s] == s) sample_of_.push_back(s);
    unknown_of_[s] = min[s] == s ? static_cast<int>(sample_of_.size()) - 1 : unknown_of_[min[s]];
  }
  std::vector<Row> rows(sample_of_.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].first = static_cast<int>(i);
  for_each_edge(level, [&](int s, int t, float) {
    const int low = std::min(unknown_of_[s], unknown_of_[t]);
    const int high = std::max(unknown_of_[s], unknown_of_[t]);
    rows[high].first = std::min(rows[high].first, low);
  });
  std::size_t count = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].start = count;
    count += i + 1 - static_cast<std::size_t>(rows[i].first);
  }
  if (count > max_entries) return;
  rows_ = std::move(rows);
  exact_.resize(count);
  place_runs();
}

void CoarseFactor::place_runs() {
  const auto padded = [](int count) {
    return std::ptrdiff_t{(count + envelope_padding - 1) / envelope_padding} * envelope_padding;
  };
  const int count = static_cast<int>(rows_.size());
  std::vector<int> last(rows_.size());
  for (int i = 0; i < count; ++i)
    for (int j = rows_[i].first; j <= i; ++j) last[j] = i;
  row_start_ = column_start_ = {0};
  for (int i = 0; i < count; ++i) {
    row_start_.push_back(row_start_.back() + padded(i - rows_[i].first));
    column_start_.push_back(column_start_.back() + padded(last[i] - i));
  }
  by_rows_.resize(static_cast<std::size_t>(row_start_.back()));
  by_columns_.resize(static_cast<std::size_t>(column_start_.back()));
  inverse_diagonal_.resize(rows_.size());
  work_ = Grid<float>(3, count + 2 * envelope_padding);
}

void CoarseFactor::assemble(const FilterLevel& level) {
  std::fill(exact_.begin(), exact_.end(), 0.0);
  const auto entry = [&](int low, int high) -> double& {
    return exact_[rows_[high].start + static_cast<std::size_t>(low - rows_[high].first)];
  };
  const int n = level.size();
  for (int s = 0; s < n * n; ++s)
    entry(unknown_of_[s], unknown_of_[s]) += double{level.own_weight(s / n, s % n)};
  for_each_edge(level, [&](int s, int t, float k) {
    const int low = std::min(unknown_of_[s], unknown_of_[t]);
    const int high = std::max(unknown_of_[s], unknown_of_[t]);
    // An edge between mates joins a particle to itself and adds nothing.
    if (low == high) return;
    entry(low, low) += double{k};
    entry(high, high) += double{k};
    entry(low, high) -= double{k};
  });
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const int s = sample_of_[i];
    const int row = static_cast<int>(i);
    if (level.inverse_diagonal(s / n, s % n) == 0) entry(row, row) = held_diagonal;
  }
}

void CoarseFactor::factor() {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    double* row = &exact_[rows_[i].start];
    const int first = rows_[i].first, last = static_cast<int>(i);
    for (int j = first; j <= last; ++j) {
      const double* other = &exact_[rows_[j].start];
      const int from = std::max(first, rows_[j].first);
      const double done = lane_sum(j - from, [&](int k) {
        return row[from - first + k] * other[from - rows_[j].first + k];
      });
      double& value = row[j - first];
      value -= done;
      value = j < last ? value / other[j - rows_[j].first] : std::sqrt(value);
    }
  }
}

void CoarseFactor::renew(const FilterLevel& level) {
  assemble(level);
  factor();
  const int count = static_cast<int>(rows_.size());
  for (int i = 0; i < count; ++i) {
    const double* row = &exact_[rows_[i].start];
    for (int j = rows_[i].first; j < i; ++j) {
      const auto entry = static_cast<float>(row[j - rows_[i].first]);
      by_rows_[static_cast<std::size_t>(row_start_[i + 1] - (i - j))] = entry;
      by_columns_[static_cast<std::size_t>(column_start_[j] + (i - j - 1))] = entry;
    }
    inverse_diagonal_[i] = static_cast<float>(1 / row[i - rows_[i].first]);
  }
}

void CoarseFactor::solve(FilterLevel& level, const KernelTable& kernels) {
  const int n = level.size();
  const Row3 x = {work_.row(0) + envelope_padding, work_.row(1) + envelope_padding,
                  work_.row(2) + envelope_padding};
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const int row = sample_of_[i] / n, col = sample_of_[i] % n;
    x.x[i] = level.rhs.x(row, col);
    x.y[i] = level.rhs.y(row, col);
    x.z[i] = level.rhs.z(row, col);
  }
  kernels.substitute({static_cast<int>(rows_.size()), inverse_diagonal_.data(), by_rows_.data(),
                      by_columns_.data(), row_start_.data(), column_start_.data()},
                     x);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const int i = unknown_of_[r * n + c];
      const bool still = level.inverse_diagonal(r, c) == 0;
      level.result.set(r, c, still ? Vec3f{} : Vec3f{x.x[i], x.y[i], x.z[i]});
    }
}

}  // namespace weft
