#include "weft/convert/chart_placement.h"

#include <algorithm>
#include <cmath>

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
             (1 - by_area) * static_cast<double>(pieces[k].triangle.size()) / triangles});
  return shares;
}

/// Sides and intervals that belong together.
class Sizing {
 public:
  Sizing(std::span<const Piece> pieces, std::span<const ChartConversion> charts,
         const SeamCurves& curves)
      : charts_(charts), curves_(curves), shares_(shares_of(pieces, charts)) {}

  [[nodiscard]] const std::vector<ChartShare>& shares() const { return shares_; }

  /// [curves] the mean of what the charts beside a curve ask for.
  [[nodiscard]] std::vector<int> intervals_at(double scale) const {
    const std::vector<int> sides = sides_at(shares_, scale);
    std::vector<double> density(curves_.length.size(), 0);
    std::vector<int> uses(density.size(), 0), least(density.size(), seam_unit);
    for (std::size_t k = 0; k < charts_.size(); ++k) {
      const std::vector<int>& shared = charts_[k].shared_curves();
      for (const int curve : shared) {
        density[curve] += 4 * (sides[k] - 1) / charts_[k].border_length();
        ++uses[curve];
        if (charts_[k].min_free_intervals() == 0)
          least[curve] = std::max(least[curve], least_of(static_cast<int>(shared.size())));
      }
    }
    std::vector<int> intervals;
    for (std::size_t c = 0; c < density.size(); ++c)
      intervals.push_back(
          std::max(least[c], whole_units(curves_.length[c] * density[c] / uses[c])));
    return intervals;
  }

  /// [charts] large enough for the intervals of their curves; where nothing else is on a chart's
  /// border, just as large as these want.
  [[nodiscard]] std::vector<int> sides_for(double scale, std::span<const int> intervals) const {
    std::vector<int> sides = sides_at(shares_, scale);
    for (std::size_t k = 0; k < charts_.size(); ++k) {
      const std::vector<int>& shared = charts_[k].shared_curves();
      if (shared.empty()) continue;
      int sum = 0;
      for (const int curve : shared) sum += intervals[curve];
      const int free = charts_[k].min_free_intervals();
      if (free == 0) {
        sides[k] = sum / 4 + 1;
        continue;
      }
      while (4 * (sides[k] - 1) < sum + free) sides[k] += seam_unit;
    }
    return sides;
  }

 private:
  /// So that a border of nothing but so many curves is that of a chart of the least side.
  static int least_of(int curves) {
    const int all = 4 * (min_image_size - 1);
    return (all / curves + seam_unit - 1) / seam_unit * seam_unit;
  }

  std::span<const ChartConversion> charts_;
  const SeamCurves& curves_;
  std::vector<ChartShare> shares_;
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

Placement place_charts(std::span<const Piece> pieces, std::span<const ChartConversion> charts,
                       const SeamCurves& curves, int asked, std::vector<std::string>& warnings) {
  if (charts.size() == 1 && curves.length.empty()) {
    const int side = asked != automatic_size ? asked : charts[0].suitable_side();
    return {side, {{"", 0, 0, side, side}}, {}};
  }
  const Sizing sizing(pieces, charts, curves);
  for (int size = asked != automatic_size ? asked : automatic_side(charts);; size = 2 * size - 1) {
    if (size > largest_image_size)
      throw TopologyError(
          "", fmt::format("{} pieces that need more samples than an image has", charts.size()),
          "fewer or simpler pieces, or --component K, are wanted");
    Placement placement{size, {}, {}};
    // Of the largest scale that fits, which is tried last of those that do.
    const auto sides_at_scale = [&](double scale) {
      return sizing.sides_for(scale, sizing.intervals_at(scale));
    };
    double scale = 0;
    std::optional<std::vector<Chart>> packed =
        pack_charts(sides_at_scale, max_scale(sizing.shares(), size), size, &scale);
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
