#include "weft/convert/chart_packing.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <deque>
#include <numeric>

namespace weft {
namespace {

constexpr int unit = 4;

int whole_side(double side) { return unit * static_cast<int>(side / unit) + 1; }

/// What is taken of an image, in units: of each column how far down.
class Skyline {
 public:
  explicit Skyline(int width) : depth_(static_cast<std::size_t>(width), 0) {}

  /// Takes a square as high up as there is room for it, there as far left.
  /// @return its column and row, in units
  std::array<int, 2> take(int width) {
    int best_col = 0, best_row = INT_MAX;
    // The columns of the window whose depth no later one reaches, deepest first.
    std::deque<int> deepest;
    for (int c = 0; c < static_cast<int>(depth_.size()); ++c) {
      while (!deepest.empty() && depth_[deepest.back()] <= depth_[c]) deepest.pop_back();
      deepest.push_back(c);
      if (deepest.front() <= c - width) deepest.pop_front();
      if (c + 1 < width || depth_[deepest.front()] >= best_row) continue;
      best_row = depth_[deepest.front()];
      best_col = c + 1 - width;
    }
    for (int c = best_col; c < best_col + width; ++c) depth_[c] = best_row + width;
    return {best_col, best_row};
  }

 private:
  std::vector<int> depth_;
};

/// The widest charts first.
std::optional<std::vector<Chart>> pack_sides(std::span<const int> sides, int size) {
  std::vector<int> order(sides.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return sides[a] > sides[b]; });
  const int width = (size - 1) / unit + 1;
  Skyline skyline(width);
  std::vector<Chart> charts(sides.size());
  for (const int k : order) {
    const int units = (sides[k] + unit - 2) / unit + 1;  // whole, with what parts it from the next
    if (units > width) return std::nullopt;
    const auto [col, row] = skyline.take(units);
    if (row + units > width) return std::nullopt;
    charts[k] = {"", unit * row, unit * col, sides[k], sides[k]};
  }
  return charts;
}

}  // namespace

std::vector<int> sides_at(std::span<const ChartShare> shares, double scale) {
  std::vector<int> sides;
  for (const ChartShare& share : shares) {
    const int least = whole_side(share.min_side + unit - 2);
    sides.push_back(std::max(least, whole_side(scale * std::sqrt(share.weight) - 1)));
  }
  return sides;
}

std::optional<std::vector<Chart>> pack_charts(const SidesAtScale& sides_at, double max_scale,
                                              int size, double* found) {
  std::optional<std::vector<Chart>> best = pack_sides(sides_at(0), size);
  if (!best) return std::nullopt;
  double fits = 0, too_much = max_scale;
  constexpr int halvings = 24;
  for (int i = 0; i < halvings; ++i) {
    const double scale = 0.5 * (fits + too_much);
    std::optional<std::vector<Chart>> packed = pack_sides(sides_at(scale), size);
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
  return pack_charts([&](double scale) { return sides_at(shares, scale); }, max_scale(shares, size),
                     size);
}

}  // namespace weft
