#include "weft/convert/chart_packing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "weft/image/skyline.h"
#include "weft/param/chart_shape.h"

namespace weft {
namespace {

constexpr int unit = 4;

int whole_side(double side) { return unit * static_cast<int>(side / unit) + 1; }

/// Whole, with what parts it from the next. [units]
int units_of(int samples) { return (samples + unit - 2) / unit + 1; }

/// In the given order.
std::optional<std::vector<Chart>> pack_in(std::span<const int> order,
                                          std::span<const ChartSize> sizes, int size) {
  const int width = (size - 1) / unit + 1;  // in units, as all of the skyline
  Skyline skyline(width);
  std::vector<Chart> charts(sizes.size());
  for (const int k : order) {
    const auto [rows, cols] = sizes[k];
    if (units_of(std::max(rows, cols)) > width) return std::nullopt;
    const auto [col, row] = skyline.take(units_of(cols), units_of(rows));
    if (row + units_of(rows) > width) return std::nullopt;
    charts[k] = {"", unit * row, unit * col, rows, cols};
  }
  return charts;
}

/// The longest charts first, or else the highest: of squares the same.
std::optional<std::vector<Chart>> pack_sizes(std::span<const ChartSize> sizes, int size) {
  std::vector<int> order(sizes.size());
  std::iota(order.begin(), order.end(), 0);
  const auto longer = [&](int k) { return std::max(sizes[k].rows, sizes[k].cols); };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return longer(a) > longer(b); });
  std::optional<std::vector<Chart>> packed = pack_in(order, sizes, size);
  const auto is_square = [](ChartSize chart) { return chart.is_square(); };
  if (packed || std::all_of(sizes.begin(), sizes.end(), is_square)) return packed;
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return sizes[a].rows > sizes[b].rows; });
  return pack_in(order, sizes, size);
}

}  // namespace

ChartSize with_border(ChartSize chart, int around, int size) {
  const bool is_square = chart.is_square();
  while (chart.around() < around) {
    const bool lengthens = is_square || chart.cols + unit <= size;
    if (is_square || !lengthens) chart.rows += unit;
    if (lengthens) chart.cols += unit;
  }
  return chart;
}

std::vector<ChartSize> sizes_at(std::span<const ChartShare> shares, double scale, int size) {
  std::vector<ChartSize> sizes;
  for (const ChartShare& share : shares) {
    const double side = scale * std::sqrt(share.weight) - 1;
    const int least = whole_side(share.min_side + unit - 2);
    if (share.aspect > 1) {
      const ChartSize free =
          chart_size(std::max(side, 1.0) * std::max(side, 1.0), share.aspect, size);
      sizes.push_back(with_border(free, 4 * (share.min_side - 1), size));
    } else {
      sizes.push_back(std::max(least, whole_side(side)));
    }
  }
  return sizes;
}

std::optional<std::vector<Chart>> pack_charts(const SizesAtScale& sizes_at, double max_scale,
                                              int size, double* found) {
  std::optional<std::vector<Chart>> best = pack_sizes(sizes_at(0), size);
  if (!best) return std::nullopt;
  double fits = 0, too_much = max_scale;
  constexpr int halvings = 24;
  for (int i = 0; i < halvings; ++i) {
    const double scale = 0.5 * (fits + too_much);
    std::optional<std::vector<Chart>> packed = pack_sizes(sizes_at(scale), size);
    (packed ? fits : too_much) = scale;
    if (packed) best = std::move(packed);
  }
  if (found != nullptr) *found = fits;
  return best;
}

double max_scale(std::span<const ChartShare> shares, int size) {
  double most = 0;
  for (const ChartShare& share : shares)
    most = std::max(most, (size + unit) / std::sqrt(share.weight));
  return most;
}

std::optional<std::vector<Chart>> pack_charts(std::span<const ChartShare> shares, int size) {
  return pack_charts([&](double scale) { return sizes_at(shares, scale, size); },
                     max_scale(shares, size), size);
}

}  // namespace weft
