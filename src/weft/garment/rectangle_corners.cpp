#include "weft/garment/rectangle_corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "weft/core/math.h"
#include "weft/garment/grid_map.h"

namespace weft {
namespace {

/// What ratios of opposite sides weigh beside angles.
constexpr double ratio_weight = 1.5;
constexpr int min_side = 4;
/// Corners are looked for at every second sample, and at fewer of borders with more than twice so
/// many: the time and memory that it takes grow with the square of their number.
constexpr int many = 2048;
/// Rectangles for which grids are tried, and how many that unfold soon are enough.
constexpr std::size_t max_choices = 64;
constexpr int enough_choices = 16;

/// An outline with what the choice asks of it.
struct Measured {
  const PanelOutline& outline;
  std::vector<double> corner_cost;  // [T] of a corner of the rectangle there
  std::vector<double> along;        // [T + 1] length from the first point [m]

  explicit Measured(const PanelOutline& given) : outline(given) {
    const int count = size();
    along.push_back(0);
    for (int i = 0; i < count; ++i) {
      const Vec2d before = at(i) - at(i - 1), after = at(i + 1) - at(i);
      double turn = arc_tangent(cross(before, after), dot(before, after));
      if (outline.mirrored) turn = -turn;
      // The square of what a right angle misses, less that of what a straight one does.
      const double right = turn / (pi / 2) - 1, straight = turn / (pi / 2);
      corner_cost.push_back(right * right - straight * straight);
      along.push_back(along.back() + weft::length(after));
    }
  }
  [[nodiscard]] int size() const { return static_cast<int>(outline.points.size()); }
  [[nodiscard]] Vec2d at(int i) const { return outline.points[(i + size()) % size()]; }
  /// Length from one point on. @param from  in 0 .. 2 T
  [[nodiscard]] double length(int from, int intervals) const {
    const auto place = [&](int i) { return along[i % size()] + (i < size() ? 0 : along[size()]); };
    return place(from + intervals) - place(from);
  }
  [[nodiscard]] double cost(int start, int cols, int rows) const {
    const std::array<int, 4> corner{start, start + cols, start + cols + rows,
                                    start + 2 * cols + rows};
    double sum = 0;
    for (const int c : corner) sum += corner_cost[c % size()];
    const double u = std::log(length(corner[0], cols) / length(corner[2], cols));
    const double v = std::log(length(corner[1], rows) / length(corner[3], rows));
    return sum + ratio_weight * (u * u + v * v);
  }
};

/// A rectangle: where it begins and how many intervals lie along its first row.
struct Choice {
  int start = 0, cols = 0;
  double cost = HUGE_VAL;
};

/// The cheapest rectangles, none of them nearly the same as a cheaper one.
std::vector<Choice> likely_choices(const Measured& measured) {
  const int half = measured.size() / 2, step = 2 * (1 + half / many);
  std::vector<Choice> all;
  for (int start = 0; start < half; start += step)  // those beyond are the same ones turned
    for (int cols = min_side; cols <= half - min_side; cols += step)
      all.push_back({start, cols, measured.cost(start, cols, half - cols)});
  std::stable_sort(all.begin(), all.end(),
                   [](const Choice& a, const Choice& b) { return a.cost < b.cost; });
  std::vector<Choice> likely;
  const int near = std::max(step, measured.size() / 40);
  for (const Choice& one : all) {
    const bool known = std::any_of(likely.begin(), likely.end(), [&](const Choice& other) {
      const auto apart = [&](int a, int b) {
        const int d = std::abs(a - b) % half;
        return std::min(d, half - d);
      };
      const int end = one.start + one.cols, other_end = other.start + other.cols;
      return (apart(one.start, other.start) < near && apart(end, other_end) < near) ||
             (apart(one.start, other_end) < near && apart(end, other.start) < near);
    });
    if (!known) likely.push_back(one);
    if (likely.size() == max_choices) break;
  }
  return likely;
}

/// The choice whose grid comes nearest to squares; the first where all stay folded.
Choice best_of(const std::vector<Choice>& likely, const PanelOutline& outline, Progress* progress) {
  const int count = static_cast<int>(outline.points.size());
  Choice best = likely.front();
  double least = HUGE_VAL;
  int unfolded = 0;
  for (const Choice& one : likely) {
    const double cost = spread_cost(outline.border_from(one.start), count / 2 - one.cols + 1,
                                    one.cols + 1, progress);
    if (cost < least) {
      least = cost;
      best = one;
    }
    if (cost < HUGE_VAL && ++unfolded == enough_choices) break;
  }
  return best;
}

}  // namespace

void choose_corners(PanelOutline& outline, Progress* progress) {
  const Measured measured(outline);
  const int half = measured.size() / 2;
  const Choice chosen = best_of(likely_choices(measured), outline, progress);
  outline.start = chosen.start;
  const int cols = chosen.cols;
  // Of the four ways to lay the rectangle, that whose columns go with the grain (y) from one to the
  // next; rows then are warp.
  double most = -HUGE_VAL;
  const int first = outline.start, across = half - cols;
  for (const int turn : {0, 1, 2, 3}) {
    const std::array<int, 4> corner{first, first + cols, first + half, first + half + cols};
    const int here = corner[turn], next = corner[(turn + 1) % 4];
    const auto at = [&](int i) { return measured.at(i % measured.size()); };
    const double lengthwise = at(next).y - at(here).y + at(here + half).y - at(next + half).y;
    if (lengthwise <= most) continue;
    most = lengthwise;
    outline.start = here % measured.size();
    outline.cols = (turn % 2 == 0 ? cols : across) + 1;
    outline.rows = (turn % 2 == 0 ? across : cols) + 1;
  }
}

}  // namespace weft
