#include "weft/cloth/newton/coarse_seams.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace weft {
namespace {

using Part = HangingNode::Part;

/// Where nodes of the level lie among the samples of the finest one: every 2^depth, and at the
/// last.
class NodePlaces {
 public:
  NodePlaces(const LevelLayout& finest, const LevelLayout& level, int depth)
      : finest_(finest), level_(level), depth_(depth), chart_of_(finest.chart_of()) {}

  [[nodiscard]] std::optional<int> node_at(int sample) const {
    const Place at = place_of(sample);
    const std::optional<int> row = along(at.row, at.from.rows, at.to.rows),
                             col = along(at.col, at.from.cols, at.to.cols);
    if (!row || !col) return std::nullopt;
    return index(at, *row, *col);
  }

  /// The two nodes that a sample of a chart's side lies between, as samples, and their weights.
  [[nodiscard]] std::array<std::pair<int, float>, 2> around(int sample) const {
    const Place at = place_of(sample);
    const bool along_row = at.row == 0 || at.row == at.from.rows - 1;
    const int x = along_row ? at.col : at.row, last = (along_row ? at.from.cols : at.from.rows) - 1,
              step = along_row ? 1 : finest_.size;
    const int before = x >> depth_ << depth_, after = std::min(before + (1 << depth_), last);
    const float weight = static_cast<float>(x - before) / static_cast<float>(after - before);
    return {std::pair(sample - (x - before) * step, 1 - weight),
            std::pair(sample + (after - x) * step, weight)};
  }

 private:
  struct Place {
    const Chart &from, &to;
    int row, col;
  };
  [[nodiscard]] Place place_of(int sample) const {
    const auto k = static_cast<std::size_t>(chart_of_[static_cast<std::size_t>(sample)]);
    const Chart& chart = finest_.charts[k];
    return {chart, level_.charts[k], sample / finest_.size - chart.row,
            sample % finest_.size - chart.col};
  }
  [[nodiscard]] std::optional<int> along(int x, int samples, int nodes) const {
    if (x == samples - 1) return nodes - 1;
    if (x % (1 << depth_) == 0) return x >> depth_;
    return std::nullopt;
  }
  [[nodiscard]] int index(const Place& at, int row, int col) const {
    return (at.to.row + row) * level_.size + at.to.col + col;
  }

  const LevelLayout &finest_, &level_;
  int depth_;
  std::vector<int> chart_of_;
};

class CoarseSeamFinder {
 public:
  CoarseSeamFinder(const BorderMates& mates, const NodePlaces& places)
      : mates_(mates), places_(places) {}

  [[nodiscard]] CoarseSeams find() {
    CoarseSeams seams;
    for (int i = 0; i < mates_.class_count(); ++i) {
      const std::span<const int> copies = mates_.copies(i);
      std::vector<int> nodes = nodes_of(copies);
      if (copies.size() < 2 || nodes.empty()) continue;
      if (!places_.node_at(copies.front())) {
        const std::vector<Part> parts = parts_between(copies.front(), 0);
        for (const int node : nodes) seams.hanging.push_back({node, parts});
      } else if (nodes.size() > 1) {
        std::sort(nodes.begin(), nodes.end());
        seams.classes.push_back(std::move(nodes));
      }
    }
    std::sort(seams.classes.begin(), seams.classes.end());
    std::sort(seams.hanging.begin(), seams.hanging.end(),
              [](const HangingNode& a, const HangingNode& b) { return a.node < b.node; });
    return seams;
  }

 private:
  [[nodiscard]] std::vector<int> nodes_of(std::span<const int> copies) const {
    std::vector<int> nodes;
    for (const int copy : copies)
      if (const std::optional<int> node = places_.node_at(copy)) nodes.push_back(*node);
    return nodes;
  }

  /// Of a sample between two nodes, which may hang themselves where a seam ends beside them; one
  /// that leads round in a circle is left out.
  [[nodiscard]] std::vector<Part> parts_between(int sample, int depth) const {
    constexpr int deepest = 4;
    std::map<int, float> sum;
    for (const auto& [end, weight] : places_.around(sample)) {
      const int first = first_copy(end);
      if (places_.node_at(first))
        sum[*places_.node_at(first)] += weight;
      else if (depth < deepest)
        for (const Part& part : parts_between(first, depth + 1))
          sum[part.node] += weight * part.weight;
    }
    return normalised(sum);
  }

  static std::vector<Part> normalised(const std::map<int, float>& sum) {
    float total = 0;
    for (const auto& [node, weight] : sum) total += weight;
    std::vector<Part> parts;
    for (const auto& [node, weight] : sum)
      if (weight > 0) parts.push_back({node, weight / total});
    return parts;
  }

  [[nodiscard]] int first_copy(int sample) const { return mates_.representative(sample); }

  const BorderMates& mates_;
  const NodePlaces& places_;
};

}  // namespace

CoarseSeams find_coarse_seams(const BorderMates& mates, const LevelLayout& finest,
                              const LevelLayout& level, int depth) {
  const NodePlaces places(finest, level, depth);
  return CoarseSeamFinder(mates, places).find();
}

}  // namespace weft
