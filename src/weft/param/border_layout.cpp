#include "weft/param/border_layout.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/param/border_curves.h"

namespace weft {
namespace {

/// Smallest side of a geometry image.
constexpr int min_side = 5;

int min_total(const std::vector<BorderCurve>& curves) {
  int total = 0;
  for (const BorderCurve& curve : curves) total += curve.weight * curve.least;
  return total;
}

/// Real-valued shares of `total` in proportion to length, none below its minimum: curves that would
/// get less are fixed at their minimum, and the rest is divided again among the others.
std::vector<double> shares(const std::vector<BorderCurve>& curves, int total) {
  double whole = 0;
  for (const BorderCurve& curve : curves) whole += curve.length;
  // A curve of no length needs a positive share too.
  const auto size = [&](const BorderCurve& c) { return whole > 0 ? c.length + 1e-9 * whole : 1.0; };
  std::vector<char> held(curves.size(), 0);
  for (std::size_t i = 0; i < curves.size(); ++i) held[i] = curves[i].fixed > 0 ? 1 : 0;
  std::vector<double> share(curves.size());
  for (bool changed = true; changed;) {
    changed = false;
    double free_total = total, free_size = 0;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      if (held[i]) free_total -= curves[i].weight * curves[i].least;
      if (!held[i]) free_size += curves[i].weight * size(curves[i]);
    }
    for (std::size_t i = 0; i < curves.size(); ++i) {
      share[i] = held[i] ? curves[i].least : free_total * size(curves[i]) / free_size;
      if (held[i] || share[i] >= curves[i].least) continue;
      held[i] = 1;
      changed = true;
    }
  }
  return share;
}

/// Largest-remainder method: the shares rounded down, then one more interval each in order of the
/// remainders. A curve with a mate takes two intervals at a time, so a single one left at the end
/// goes to a true border path.
std::vector<int> apportion(const std::vector<BorderCurve>& curves, int total) {
  const std::vector<double> share = shares(curves, total);
  std::vector<int> counts(curves.size()), order;
  int left = total;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    counts[i] = std::max(curves[i].least, static_cast<int>(std::floor(share[i])));
    left -= curves[i].weight * counts[i];
    if (curves[i].fixed == 0) order.push_back(static_cast<int>(i));
  }
  const auto rank = [&](int i) { return std::tuple(counts[i] - share[i], -curves[i].length, i); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return rank(a) < rank(b); });
  while (left > 0)
    for (const int i : order) {
      if (curves[i].weight > left) continue;
      ++counts[i];
      left -= curves[i].weight;
    }
  return counts;
}

/// Whether step * counts is within a thirty-second of every share and not below any minimum.
bool near_enough(const std::vector<BorderCurve>& curves, const std::vector<double>& share,
                 const std::vector<int>& counts, int step) {
  constexpr double tolerance = 1.0 / 32;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const int intervals = step * counts[i];
    if (curves[i].fixed > 0) continue;
    if (intervals < curves[i].least) return false;
    if (std::abs(intervals - share[i]) > tolerance * share[i]) return false;
  }
  return true;
}

/// The curves with their fixed numbers of intervals counted in steps of several, where that can be.
std::optional<std::vector<BorderCurve>> with_fixed_in(std::vector<BorderCurve> curves, int step) {
  for (BorderCurve& curve : curves) {
    if (curve.fixed % step != 0) return std::nullopt;
    if (curve.fixed > 0) curve.least = curve.fixed = curve.fixed / step;
  }
  return curves;
}

/// Whether curves can have so many intervals in all: where every free one has a mate, what the
/// fixed ones leave has to be even.
bool can_have(const std::vector<BorderCurve>& curves, int total) {
  int left = total;
  for (const BorderCurve& curve : curves) left -= curve.weight * curve.fixed;
  const auto takes_one = [](const BorderCurve& c) { return c.fixed == 0 && c.weight == 1; };
  return min_total(curves) <= total &&
         (left % 2 == 0 || std::any_of(curves.begin(), curves.end(), takes_one));
}

/// Interval counts in multiples of the largest power of two that divides the sides and for which
/// near_enough holds; any counts where there is none.
std::vector<int> aligned_counts(const std::vector<BorderCurve>& curves, ChartSize size) {
  const int total = size.around();
  const int sides = std::gcd(size.rows - 1, size.cols - 1);
  const std::vector<double> share = shares(curves, total);
  int step = 1;
  while (sides % (2 * step) == 0) step *= 2;
  for (; step > 1; step /= 2) {
    const std::optional<std::vector<BorderCurve>> in_steps = with_fixed_in(curves, step);
    if (!in_steps || !can_have(*in_steps, total / step)) continue;
    std::vector<int> counts = apportion(*in_steps, total / step);
    if (!near_enough(curves, share, counts, step)) continue;
    for (int& count : counts) count *= step;
    return counts;
  }
  return apportion(curves, total);
}

std::string text_of(ChartSize size) {
  return size.is_square() ? std::to_string(size.rows)
                          : fmt::format("{} x {}", size.rows, size.cols);
}

}  // namespace

Vec2d border_point(ChartSize size, double t) {
  const double width = size.cols - 1, height = size.rows - 1;
  if (t <= width) return {t, 0};
  if (t <= width + height) return {width, t - width};
  if (t <= 2 * width + height) return {2 * width + height - t, height};
  return {0, 2 * (width + height) - t};
}

double border_position_of(ChartSize size, Vec2d point) {
  const double width = size.cols - 1, height = size.rows - 1;
  if (point.y <= 0 && point.x < width) return point.x;
  if (point.x >= width && point.y < height) return width + point.y;
  if (point.y >= height && point.x > 0) return 2 * width + height - point.x;
  return 2 * (width + height) - point.y;
}

int chart_sample(ChartSize size, int position, int stride) {
  const Vec2d point = border_point(size, position);
  return static_cast<int>(point.y) * stride + static_cast<int>(point.x);
}

int min_size(const CutDisk& cut) {
  const int total = min_total(border_curves(cut));
  return std::max(min_side, (total + 3) / 4 + 1);
}

bool has_room(ChartSize size, const CutDisk& cut) {
  return std::min(size.rows, size.cols) >= min_side &&
         size.around() >= min_total(border_curves(cut));
}

bool has_free_path(const CutDisk& cut) {
  return std::any_of(cut.paths.begin(), cut.paths.end(),
                     [](const BorderPath& path) { return path.intervals == 0; });
}

BorderLayout lay_out_border(const CutDisk& cut, const LayoutOptions& options) {
  if (!has_room(options.size, cut))
    throw TopologyError("",
                        fmt::format("size {} is too small for the cut's {} border paths",
                                    text_of(options.size), cut.paths.size()),
                        fmt::format("size {} or more", min_size(cut)));
  const int total = options.size.around();
  const std::vector<BorderCurve> curves = border_curves(cut);
  if (!has_free_path(cut) && min_total(curves) != total)
    throw TopologyError("",
                        fmt::format("{} border intervals are fixed, a chart of {} has {}",
                                    min_total(curves), text_of(options.size), total),
                        "a border whose intervals fit is wanted");
  const std::vector<int> counts =
      options.align ? aligned_counts(curves, options.size) : apportion(curves, total);
  BorderLayout layout;
  layout.size = options.size;
  layout.intervals.resize(cut.paths.size());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const int mate = cut.paths[curves[i].path].mate;
    layout.intervals[curves[i].path] = counts[i];
    if (mate >= 0) layout.intervals[mate] = counts[i];
  }
  int position = (options.rotation % total + total) % total;
  for (const int intervals : layout.intervals) {
    layout.first.push_back(position);
    position = (position + intervals) % total;
  }
  return layout;
}

}  // namespace weft
