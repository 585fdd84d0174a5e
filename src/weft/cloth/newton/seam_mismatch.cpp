#include "weft/cloth/newton/seam_mismatch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace weft {
namespace {

/// A value as a sum of those of nodes that do not hang, at first copies.
using Sum = std::map<int, float>;

/// Weights below this come from rounding.
constexpr float negligible_weight = 1e-4F;

void add_scaled(float factor, const Sum& sum, Sum& total) {
  for (const auto& [node, weight] : sum) total[node] += factor * weight;
}

std::vector<std::pair<int, float>> parts_of(const Sum& sum) {
  std::vector<std::pair<int, float>> parts;
  for (const auto& part : sum)
    if (std::abs(part.second) > negligible_weight) parts.emplace_back(part);
  return parts;
}

/// What the nodes of a level stand for.
class NodeValues {
 public:
  explicit NodeValues(const Seams& seams) {
    for (int i = 0; i < seams.class_count(); ++i)
      for (const int s : seams.samples(i)) values_[s] = {{seams.samples(i).front(), 1.0F}};
    for (const HangingNode& one : seams.hanging()) {
      Sum& value = values_[one.node];
      for (const HangingNode::Part& part : one.parts)
        value[values_.at(part.node).begin()->first] += part.weight;
    }
  }
  void add(float factor, int node, Sum& total) const {
    if (const auto found = values_.find(node); found != values_.end())
      add_scaled(factor, found->second, total);
    else
      total[node] += factor;
  }

 private:
  std::map<int, Sum> values_;
};

/// The values of a fine level's samples: interpolated in their own charts, and the means of copies.
class FineValues {
 public:
  FineValues(const SeamMismatch::Level& fine, const SeamMismatch::Level& coarse)
      : fine_(fine), coarse_(coarse), chart_of_(fine.layout.chart_of()), nodes_(coarse.seams) {
    for (int i = 0; i < fine.seams.class_count(); ++i) {
      const std::span<const int> copies = fine.seams.samples(i);
      Sum& mean = means_[copies.front()];
      for (const int s : copies)
        add_scaled(1 / static_cast<float>(copies.size()), interpolated(s), mean);
      for (const int s : copies) first_[s] = copies.front();
    }
  }

  [[nodiscard]] Sum interpolated(int sample) const {
    const auto k = static_cast<std::size_t>(chart_of_[static_cast<std::size_t>(sample)]);
    const Chart &from = fine_.layout.charts[k], &to = coarse_.layout.charts[k];
    const int n = fine_.layout.size;
    Sum sum;
    for (const auto& [row, down] : along(sample / n - from.row, from.rows))
      for (const auto& [col, right] : along(sample % n - from.col, from.cols))
        if (down * right > 0)
          nodes_.add(down * right, (to.row + row) * coarse_.layout.size + to.col + col, sum);
    return sum;
  }
  /// Of a sample that does not hang.
  [[nodiscard]] Sum mean(int sample) const {
    const auto first = first_.find(sample);
    return first == first_.end() ? interpolated(sample) : means_.at(first->second);
  }

 private:
  /// The nodes of a coarse line that a sample lies between, with their weights; the last sample
  /// lies at the last node.
  static std::array<std::pair<int, float>, 2> along(int x, int samples) {
    const int node = x == samples - 1 ? samples / 2 : x / 2;
    if (x == samples - 1 || x % 2 == 0) return {std::pair(node, 1.0F), std::pair(node, 0.0F)};
    return {std::pair(node, 0.5F), std::pair(node + 1, 0.5F)};
  }

  SeamMismatch::Level fine_, coarse_;
  std::vector<int> chart_of_;
  NodeValues nodes_;
  std::map<int, Sum> means_;  // by the first copy
  std::map<int, int> first_;
};

}  // namespace

SeamMismatch::SeamMismatch(const SeamMismatch& finer, const Level& fine, const Level& coarse) {
  const FineValues values(fine, coarse);
  for (std::size_t i = 0; i < finer.copies_.size(); ++i) {
    Sum sum;
    for (const auto& [node, weight] : finer.parts(finer.copies_[i]))
      add_scaled(weight, values.mean(finer.nodes_[node]), sum);
    add(static_cast<int>(i), parts_of(sum));
  }
  inherited_ = static_cast<int>(copies_.size());
  const auto add_difference = [&](int sample, Sum sum) {
    add_scaled(-1, values.interpolated(sample), sum);
    add(sample, parts_of(sum));
  };
  for (int i = 0; i < fine.seams.class_count(); ++i)
    for (const int s : fine.seams.samples(i)) add_difference(s, values.mean(s));
  for (const HangingNode& one : fine.seams.hanging()) {
    Sum sum;
    for (const HangingNode::Part& part : one.parts)
      add_scaled(part.weight, values.mean(part.node), sum);
    add_difference(one.node, std::move(sum));
  }
  find_pattern();
}

void SeamMismatch::add(int source, const std::vector<Part>& difference) {
  if (difference.empty()) return;
  Copy copy{source, static_cast<int>(parts_.size())};
  parts_.insert(parts_.end(), difference.begin(), difference.end());
  copy.last = static_cast<int>(parts_.size());
  copies_.push_back(copy);
}

/// Numbers the nodes, and finds the blocks of E.
void SeamMismatch::find_pattern() {
  for (const Part& part : parts_) nodes_.push_back(part.first);
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  for (Part& part : parts_)
    part.first = static_cast<int>(std::lower_bound(nodes_.begin(), nodes_.end(), part.first) -
                                  nodes_.begin());
  std::map<std::pair<int, int>, int> index;
  for (const Copy& copy : copies_)
    for (const Part& a : parts(copy))
      for (const Part& b : parts(copy)) index[{a.first, b.first}] = 0;
  starts_.assign(nodes_.size() + 1, 0);
  for (auto& [pair, place] : index) {
    place = block_count();
    rows_.push_back(pair.first);
    columns_.push_back(pair.second);
    starts_[static_cast<std::size_t>(pair.first) + 1] = block_count();
  }
  for (Copy& copy : copies_) {
    copy.place = static_cast<int>(places_.size());
    for (const Part& a : parts(copy))
      for (const Part& b : parts(copy)) places_.push_back(index.at({a.first, b.first}));
  }
  own_.resize(copies_.size() * block_entries);
  blocks_.resize(columns_.size() * block_entries);
  bounds_.resize(nodes_.size() * block_entries);
  kept_ = bounds_;
}

void SeamMismatch::gather(const SeamMismatch& finer, const PlaneSet& fine_stencil) {
  const int n = fine_stencil.rows();
  std::fill(blocks_.begin(), blocks_.end(), 0.0F);
  std::fill(bounds_.begin(), bounds_.end(), 0.0F);
  for (std::size_t i = 0; i < copies_.size(); ++i) {
    const int source = copies_[i].source;
    float* const own = &own_[i * block_entries];
    for (int k = 0; k < block_entries; ++k)
      own[k] = static_cast<int>(i) < inherited_ ? finer.own_[source * block_entries + k]
                                                : fine_stencil(source / n, source % n, k);
    add_energy(copies_[i], own);
  }
}

void SeamMismatch::add_energy(const Copy& copy, const float* own) {
  const std::span<const Part> differing = parts(copy);
  float total = 0;
  for (const Part& part : differing) total += std::abs(part.second);
  const int* place = &places_[copy.place];
  for (const auto& [a, weight] : differing) {
    float* const bound = &bounds_[a * block_entries];
    for (int k = 0; k < block_entries; ++k) bound[k] += total * std::abs(weight) * own[k];
    for (const auto& [b, other] : differing) {
      float* const block = &blocks_[*place++ * block_entries];
      for (int k = 0; k < block_entries; ++k) block[k] += weight * other * own[k];
    }
  }
}

void SeamMismatch::subtract(const Workers& workers, const PaddedVectors& value,
                            PaddedVectors& residual) const {
  const int n = value.rows();
  const Range mine = workers.share(static_cast<int>(nodes_.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    float x = 0, y = 0, z = 0;
    for (int k = starts_[i]; k < starts_[i + 1]; ++k) {
      const int r = nodes_[columns_[k]] / n, c = nodes_[columns_[k]] % n;
      const float* const b = &blocks_[k * block_entries];
      const float vx = value.x(r, c), vy = value.y(r, c), vz = value.z(r, c);
      x += b[0] * vx + b[1] * vy + b[2] * vz;
      y += b[1] * vx + b[3] * vy + b[4] * vz;
      z += b[2] * vx + b[4] * vy + b[5] * vz;
    }
    const int r = nodes_[i] / n, c = nodes_[i] % n;
    residual.x(r, c) -= x;
    residual.y(r, c) -= y;
    residual.z(r, c) -= z;
  }
}

void SeamMismatch::join(PlaneSet& stencil) {
  const int n = stencil.rows();
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    for (int k = 0; k < block_entries; ++k) {
      float& centre = stencil(nodes_[i] / n, nodes_[i] % n, k);
      kept_[i * block_entries + k] = centre;
      centre += bounds_[i * block_entries + k];
    }
}

void SeamMismatch::part(PlaneSet& stencil) const {
  const int n = stencil.rows();
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    for (int k = 0; k < block_entries; ++k)
      stencil(nodes_[i] / n, nodes_[i] % n, k) = kept_[i * block_entries + k];
}

}  // namespace weft
