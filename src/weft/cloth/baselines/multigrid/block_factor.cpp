#include "weft/cloth/baselines/multigrid/block_factor.h"

#include <algorithm>
#include <cmath>

#include "weft/cloth/neighbours.h"
#include "weft/core/ordered_sum.h"

namespace weft {
namespace {

/// Largest level that is factored: 192 rows, which take some 0.1 ms.
constexpr int max_particles = 64;

}  // namespace

BlockFactor::BlockFactor(const FilterLevel& level) {
  const int n = level.size();
  unknown_of_.resize(static_cast<std::size_t>(n) * n);
  for (int s = 0; s < n * n; ++s) {
    const int first = level.mates.representative(s);
    if (first == s) sample_of_.push_back(s);
    unknown_of_[s] = first == s ? static_cast<int>(sample_of_.size()) - 1 : unknown_of_[first];
  }
  if (sample_of_.size() > max_particles) {
    sample_of_.clear();
    return;
  }
  count_ = 3 * static_cast<int>(sample_of_.size());
  matrix_.resize(static_cast<std::size_t>(count_) * count_);
  x_.resize(static_cast<std::size_t>(count_));
}

void BlockFactor::add_edge(int i, int j, double k) {
  // An edge between mates joins a particle to itself and adds nothing.
  if (i == j) return;
  for (int a = 0; a < 3; ++a) {
    entry(3 * i + a, 3 * i + a) += k;
    entry(3 * j + a, 3 * j + a) += k;
    entry(3 * std::max(i, j) + a, 3 * std::min(i, j) + a) -= k;
  }
}

void BlockFactor::assemble(const FilterLevel& level) {
  std::fill(matrix_.begin(), matrix_.end(), 0.0);
  const int n = level.size();
  for (int s = 0; s < n * n; ++s) {
    const int first = 3 * unknown_of_[s];
    const auto [xx, xy, xz, yy, yz, zz] = level.contacts.block(s);
    const double weight = level.own_weight(s / n, s % n);
    entry(first, first) += weight + double{xx};
    entry(first + 1, first) += double{xy};
    entry(first + 1, first + 1) += weight + double{yy};
    entry(first + 2, first) += double{xz};
    entry(first + 2, first + 1) += double{yz};
    entry(first + 2, first + 2) += weight + double{zz};
  }
  for (int d = 0; d < bend_u; ++d) {
    const auto [down, right] = spring_offsets[d];
    for (int r = 0; r + down < n; ++r)
      for (int c = std::max(0, -right); c + std::max(0, right) < n; ++c)
        add_edge(unknown_of_[r * n + c], unknown_of_[(r + down) * n + c + right],
                 double{level.edge[d](r, c)});
  }
}

void BlockFactor::factor() {
  for (int i = 0; i < count_; ++i)
    for (int j = 0; j <= i; ++j) {
      const double *a = &entry(i, 0), *b = &entry(j, 0);
      double& value = entry(i, j);
      value -= lane_sum(j, [&](int k) { return a[k] * b[k]; });
      value = j < i ? value / entry(j, j) : std::sqrt(value);
    }
}

void BlockFactor::renew(const FilterLevel& level) {
  assemble(level);
  const int n = level.size();
  for (std::size_t i = 0; i < sample_of_.size(); ++i) {
    const int s = sample_of_[i], first = 3 * static_cast<int>(i);
    if (level.inverse_diagonal(s / n, s % n) > 0) continue;
    for (int a = 0; a < 3; ++a) entry(first + a, first + a) = held_diagonal;
  }
  factor();
}

void BlockFactor::solve(FilterLevel& level) {
  const int n = level.size();
  for (std::size_t i = 0; i < sample_of_.size(); ++i) {
    const Vec3f b = level.rhs.at(sample_of_[i]);
    x_[3 * i] = b.x, x_[3 * i + 1] = b.y, x_[3 * i + 2] = b.z;
  }
  for (int i = 0; i < count_; ++i) {
    const double* row = &entry(i, 0);
    x_[i] = (x_[i] - lane_sum(i, [&](int k) { return row[k] * x_[k]; })) / row[i];
  }
  for (int i = count_ - 1; i >= 0; --i) {
    const double* row = &entry(i, 0);
    x_[i] /= row[i];
    for (int k = 0; k < i; ++k) x_[k] -= row[k] * x_[i];
  }
  for (int s = 0; s < n * n; ++s) {
    const double* x = &x_[3 * static_cast<std::size_t>(unknown_of_[s])];
    const bool still = level.inverse_diagonal(s / n, s % n) == 0;
    level.result.set(s, still ? Vec3f{} : vec_cast<float>(Vec3d{x[0], x[1], x[2]}));
  }
}

}  // namespace weft
