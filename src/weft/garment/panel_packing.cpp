#include "weft/garment/panel_packing.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace weft {
namespace {

constexpr int gap = 2;

/// How far down each column of an image is taken.
class Skyline {
 public:
  explicit Skyline(int width) : depth_(static_cast<std::size_t>(width + gap), 0) {}
  /// Takes a rectangle as high up as there is room for it, there as far left; nothing where the
  /// image is too low.
  bool take(Chart& chart) {
    const int width = chart.cols + gap, size = static_cast<int>(depth_.size());
    chart.row = size;
    for (int col = 0; col + width <= size; ++col) {
      const int row = *std::max_element(depth_.begin() + col, depth_.begin() + col + width);
      if (row < chart.row) {
        chart.row = row;
        chart.col = col;
      }
    }
    if (chart.row + chart.rows + gap > size) return false;
    std::fill_n(depth_.begin() + chart.col, width, chart.row + chart.rows + gap);
    return true;
  }

 private:
  std::vector<int> depth_;
};

}  // namespace

std::vector<Chart> pack_panels(std::span<const PanelOutline> outlines, int& size) {
  std::vector<int> order(outlines.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return outlines[a].rows > outlines[b].rows; });
  std::vector<Chart> charts(outlines.size());
  size = min_image_size;
  for (const PanelOutline& outline : outlines) size = std::max({size, outline.rows, outline.cols});
  for (bool placed = false; !placed; size += placed ? 0 : 1) {
    Skyline skyline(size);
    placed = std::all_of(order.begin(), order.end(), [&](int k) {
      charts[k] = {"", 0, 0, outlines[k].rows, outlines[k].cols};
      return skyline.take(charts[k]);
    });
  }
  return charts;
}

}  // namespace weft
