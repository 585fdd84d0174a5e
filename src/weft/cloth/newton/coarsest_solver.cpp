#include "weft/cloth/newton/coarsest_solver.h"

#include <algorithm>
#include <array>

#include "weft/cloth/bending.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

constexpr std::array<std::array<int, 3>, 3> entry_of{{{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};
/// A pivot is at least this part of its diagonal entry: three times what the entries, which are
/// floats, are rounded by. Smaller ones would be made by rounding alone, and what they are divided
/// into would grow without bound.
constexpr double min_pivot = 3 * 0x1p-24;

}  // namespace

CoarsestSolver::CoarsestSolver(const BlockLevel& level) {
  number_nodes(level);
  const int nodes = 1 + *std::max_element(node_.begin(), node_.end());
  if (nodes > max_nodes) return;
  unknowns_ = 3 * nodes;
  matrix_.resize(static_cast<std::size_t>(unknowns_) * unknowns_);
  value_.resize(unknowns_);
  first_.resize(unknowns_);
  find_bending(level);
}

void CoarsestSolver::number_nodes(const BlockLevel& level) {
  const int n = level.size, samples = n * n;
  std::vector<int> first_copy(samples);
  for (int s = 0; s < samples; ++s) first_copy[s] = s;
  for (int i = 0; i < level.seams.class_count(); ++i)
    for (const int s : level.seams.samples(i)) first_copy[s] = level.seams.samples(i).front();
  for (const HangingNode& hanging : level.seams.hanging()) first_copy[hanging.node] = -1;
  const std::vector<int> chart_of = level.layout.chart_of();
  node_.assign(samples, -1);
  parts_.resize(samples);
  int nodes = 0;
  for (int s = 0; s < samples; ++s) {
    if (chart_of[s] < 0 || first_copy[s] < 0) continue;
    node_[s] = first_copy[s] == s ? nodes++ : node_[first_copy[s]];
    parts_[s] = {{node_[s], 1}};
  }
  for (const HangingNode& hanging : level.seams.hanging())
    for (const HangingNode::Part& part : hanging.parts)
      parts_[hanging.node].push_back({node_[part.node], part.weight});
}

/// M^T M of flat bending, M summed over copies.
void CoarsestSolver::find_bending(const BlockLevel& level) {
  const int n = level.size, nodes = unknowns_ / 3;
  std::vector<double> curve(static_cast<std::size_t>(nodes) * nodes);  // M
  const auto add = [&](int from, int to, double weight) {
    for (const Part& a : parts_[from])
      for (const Part& b : parts_[to])
        curve[a.node * nodes + b.node] += a.weight * weight * b.weight;
  };
  for (int s = 0; s < n * n; ++s)
    for (int k = 0; k < level.bending.neighbours() && !parts_[s].empty(); ++k) {
      const int r = s / n + bending_offsets[k].down, c = s % n + bending_offsets[k].right;
      if (r < 0 || r >= n || c < 0 || c >= n || parts_[r * n + c].empty()) continue;
      const double w = level.bending.weight(k, s / n, s % n);
      add(s, r * n + c, w);
      add(s, s, -w);
    }
  bending_.resize(curve.size());
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j)
      for (int k = 0; k < nodes; ++k)
        bending_[i * nodes + j] += curve[k * nodes + i] * curve[k * nodes + j];
}

void CoarsestSolver::add_block(int from, int to, const PlaneSet& stencil, int block, int sample) {
  const int n = stencil.rows();
  for (const Part& a : parts_[from])
    for (const Part& b : parts_[to])
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          at(3 * a.node + i, 3 * b.node + j) +=
              a.weight * b.weight *
              double{stencil(sample / n, sample % n, block * block_entries + entry_of[i][j])};
}

void CoarsestSolver::factor(const BlockLevel& level) noexcept {
  const int n = level.size, nodes = unknowns_ / 3;
  std::fill(matrix_.begin(), matrix_.end(), 0.0);
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j)
      for (int k = 0; k < 3; ++k) at(3 * i + k, 3 * j + k) = bending_[i * nodes + j];
  for (int s = 0; s < n * n; ++s) {
    const int r = s / n, c = s % n;
    if (parts_[s].empty()) continue;
    add_block(s, s, level.stencil, 0, s);
    for (int d = 0; d < near_directions; ++d) {
      const auto [down, right] = spring_offsets[d];
      if (r + down >= n || c + right >= n || c + right < 0) continue;
      const int other = (r + down) * n + c + right;
      if (parts_[other].empty()) continue;
      add_block(s, other, level.stencil, 1 + d, s);
      add_block(other, s, level.stencil, 1 + d, s);
    }
  }
  add_mismatch(level.mismatch);
  hold_pins(level);
  for (int i = 0; i < unknowns_; ++i) {
    first_[i] = 0;
    while (first_[i] < i && at(i, first_[i]) == 0) ++first_[i];
  }
  for (int j = 0; j < unknowns_; ++j) {
    const double before = at(j, j);
    double pivot = before;
    for (int k = first_[j]; k < j; ++k) pivot -= at(j, k) * at(j, k) * at(k, k);
    // The diagonal keeps D, 0 for unknowns that do not move.
    // One clearly below 0 is not made by rounding: parts of bending's border whose rest is masked
    // by pins have less than no energy. Such an unknown is left to its own diagonal.
    if (pivot < -min_pivot * before) pivot = before;
    pivot = std::max(pivot, min_pivot * before);
    const bool moves = pivot > 0;
    for (int i = j + 1; i < unknowns_; ++i) {
      if (first_[i] > j) continue;
      double sum = at(i, j);
      for (int k = std::max(first_[i], first_[j]); k < j; ++k)
        sum -= at(i, k) * at(j, k) * at(k, k);
      at(i, j) = moves ? sum / pivot : 0;
    }
    at(j, j) = moves ? pivot : 0;
  }
}

void CoarsestSolver::add_mismatch(const SeamMismatch& mismatch) {
  for (int k = 0; k < mismatch.block_count(); ++k) {
    const auto [row, col, entries] = mismatch.block(k);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        at(3 * node_[row] + i, 3 * node_[col] + j) += double{entries[entry_of[i][j]]};
  }
}

void CoarsestSolver::hold_pins(const BlockLevel& level) {
  if (!level.holds_pins) return;
  for (const BlockLevel::Pin& pin : level.pins)
    for (int k = 0; k < 3 && node_[pin.sample] >= 0; ++k)
      for (int other = 0; other < unknowns_; ++other)
        at(3 * node_[pin.sample] + k, other) = at(other, 3 * node_[pin.sample] + k) = 0;
}

void CoarsestSolver::solve(BlockLevel& level) noexcept {
  const int n = level.size;
  const std::array<const PaddedPlane*, 3> rhs{&level.rhs.x, &level.rhs.y, &level.rhs.z};
  for (int s = 0; s < n * n; ++s)
    for (int k = 0; k < 3 && node_[s] >= 0; ++k) value_[3 * node_[s] + k] = (*rhs[k])(s / n, s % n);
  for (int i = 0; i < unknowns_; ++i)
    for (int k = first_[i]; k < i; ++k) value_[i] -= at(i, k) * value_[k];
  for (int i = unknowns_ - 1; i >= 0; --i) {
    value_[i] = at(i, i) > 0 ? value_[i] / at(i, i) : 0;
    for (int k = i + 1; k < unknowns_; ++k) value_[i] -= at(k, i) * value_[k];
  }
  const std::array<PaddedPlane*, 3> value{&level.value.x, &level.value.y, &level.value.z};
  for (int s = 0; s < n * n; ++s)
    for (int k = 0; k < 3 && !parts_[s].empty(); ++k) {
      double mean = 0;
      for (const Part& part : parts_[s]) mean += part.weight * value_[3 * part.node + k];
      (*value[k])(s / n, s % n) = static_cast<float>(mean);
    }
}

}  // namespace weft
