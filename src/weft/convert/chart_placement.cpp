#include "weft/convert/chart_placement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "weft/convert/chart_packing.h"
#include "weft/error.h"

namespace weft {
namespace {

constexpr int min_automatic_size = 33;
/// Of several charts, more samples than this are to be asked for.
constexpr int max_for_many = 1025;
/// Counts of intervals on seams are multiples of it, so that two coarser levels match, too.
constexpr int seam_unit = 4;

int whole_units(double intervals) {
  return seam_unit * std::max(1, static_cast<int>(std::lround(intervals / seam_unit)));
}

std::vector<ChartShare> shares_of(std::span<const Piece> pieces,
                                  std::span<const ChartConversion> charts) {
  constexpr double by_area = 0.75;
  double area = 0, triangles = 0;
  for (const Piece& piece : pieces) {
    area += piece.area;
    triangles += static_cast<double>(piece.triangle.size());
  }
  std::vector<ChartShare> shares;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    shares.push_back(
        {charts[k].min_side(),
         by_area * pieces[k].area / area +
             (1 - by_area) * static_cast<double>(pieces[k].triangle.size()) / triangles,
         charts[k].aspect()});
  return shares;
}

/// Sizes and intervals that belong together, in an image of a given size.
class Sizing {
 public:
  Sizing(std::span<const Piece> pieces, std::span<const ChartConversion> charts,
         const SeamCurves& curves, int size)
      : charts_(charts), curves_(curves), shares_(shares_of(pieces, charts)), size_(size) {}

  [[nodiscard]] const std::vector<ChartShare>& shares() const { return shares_; }

  /// [curves] the mean of what the charts beside a curve ask for, but no more than a rectangle
  /// does: that may be as long as the image already.
  [[nodiscard]] std::vector<int> intervals_at(double scale) const {
    const std::vector<ChartSize> sizes = sizes_at(shares_, scale, size_);
    std::vector<double> density(curves_.length.size(), 0);
    std::vector<double> most(density.size(), std::numeric_limits<double>::infinity());
    std::vector<int> uses(density.size(), 0), least(density.size(), seam_unit);
    for (std::size_t k = 0; k < charts_.size(); ++k) {
      const std::vector<int>& shared = charts_[k].shared_curves();
      for (const int curve : shared) {
        const double own = sizes[k].around() / charts_[k].border_length();
        density[curve] += own;
        if (shares_[k].aspect > 1) most[curve] = std::min(most[curve], own);
        ++uses[curve];
        if (charts_[k].min_free_intervals() == 0)
          least[curve] = std::max(least[curve], least_of(static_cast<int>(shared.size())));
      }
    }
    std::vector<int> intervals;
    for (std::size_t c = 0; c < density.size(); ++c)
      intervals.push_back(std::max(
          least[c], whole_units(curves_.length[c] * std::min(most[c], density[c] / uses[c]))));
    return intervals;
  }

  /// [charts] large enough for the intervals of their curves; where nothing else is on a chart's
  /// border, just as large as these want.
  [[nodiscard]] std::vector<ChartSize> sizes_for(double scale,
                                                 std::span<const int> intervals) const {
    std::vector<ChartSize> sizes = sizes_at(shares_, scale, size_);
    for (std::size_t k = 0; k < charts_.size(); ++k) {
      const std::vector<int>& shared = charts_[k].shared_curves();
      if (shared.empty()) continue;
      int sum = 0;
      for (const int curve : shared) sum += intervals[curve];
      const int free = charts_[k].min_free_intervals();
      sizes[k] =
          free == 0 ? size_around(sum, shares_[k].aspect)
                    : with_border(sizes[k], std::max(sum + free, even_border(k, intervals)), size_);
    }
    return sizes;
  }

 private:
  /// So that a border of nothing but so many curves is that of a chart of the least side.
  static int least_of(int curves) {
    const int all = 4 * (min_image_size - 1);
    return (all / curves + seam_unit - 1) / seam_unit * seam_unit;
  }

  /// A strip that has more samples along one side than along the other is skewed: how many it wants
  /// around it for those of its curves. Short curves, which have the least number, ask for nothing.
  [[nodiscard]] int even_border(std::size_t chart, std::span<const int> intervals) const {
    if (shares_[chart].aspect <= 1) return 0;
    double sum = 0, length = 0;
    for (const int curve : charts_[chart].shared_curves()) {
      if (intervals[curve] <= seam_unit) continue;
      sum += intervals[curve];
      length += curves_.length[curve];
    }
    if (!(length > 0)) return 0;
    return static_cast<int>(
        std::min(std::ceil(sum * charts_[chart].border_length() / length), 4.0 * size_));
  }

  /// The chart of an aspect whose border has just so many intervals.
  [[nodiscard]] ChartSize size_around(int intervals, double aspect) const {
    const int half = intervals / 2, longest = (size_ - 1) / seam_unit * seam_unit;
    const int wanted = std::max(min_shorter(half / 2), whole_units(half / (1 + aspect)));
    const int shorter = std::max(wanted, half - longest);
    if (aspect <= 1 || shorter >= half - shorter) return intervals / 4 + 1;
    return {shorter + 1, half - shorter + 1};
  }

  std::span<const ChartConversion> charts_;
  const SeamCurves& curves_;
  std::vector<ChartShare> shares_;
  int size_;
};

int automatic_side(std::span<const ChartConversion> charts) {
  double suitable = 0;
  for (const ChartConversion& chart : charts)
    suitable += static_cast<double>(chart.suitable_side()) * chart.suitable_side();
  int size = min_automatic_size;
  while (size < max_for_many && size * size < suitable) size = 2 * size - 1;
  return size;
}

}  // namespace

std::optional<Placement> place_charts(std::span<const Piece> pieces,
                                      std::span<const ChartConversion> charts,
                                      const SeamCurves& curves, int asked, int most,
                                      std::vector<std::string>& warnings) {
  if (charts.size() == 1 && curves.length.empty()) {
    const int side = asked != automatic_size ? asked : charts[0].suitable_side();
    return Placement{side, {{"", 0, 0, side, side}}, {}};
  }
  for (int size = asked != automatic_size ? asked : automatic_side(charts);; size = 2 * size - 1) {
    if (size > most) return std::nullopt;
    const Sizing sizing(pieces, charts, curves, size);
    Placement placement{size, {}, {}};
    // Of the largest scale that fits, which is tried last of those that do.
    const auto sizes_at_scale = [&](double scale) {
      return sizing.sizes_for(scale, sizing.intervals_at(scale));
    };
    double scale = 0;
    std::optional<std::vector<Chart>> packed =
        pack_charts(sizes_at_scale, max_scale(sizing.shares(), size), size, &scale);
    if (!packed) continue;
    if (asked != automatic_size && size != asked)
      warnings.push_back(
          fmt::format("{} pieces do not fit into {} x {} samples: {} x {} were taken",
                      charts.size(), asked, asked, size, size));
    placement.charts = std::move(*packed);
    placement.intervals = sizing.intervals_at(scale);
    return placement;
  }
}

}  // namespace weft
