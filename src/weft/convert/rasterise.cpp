#include "weft/convert/rasterise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "weft/core/orientation.h"
#include "weft/grid.h"

namespace weft {
namespace {

struct Span {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// The interior samples in a span, widened by a rounding margin by one sample at most at either end:
// none is lost, and those in the range are tested exactly.
struct SampleRange {
  int first, last;
  SampleRange(Span span, double samples_per_unit, int size)
      : first(static_cast<int>(
            std::clamp(std::ceil(span.low * samples_per_unit - margin), 1.0, size - 1.0))),
        last(static_cast<int>(
            std::clamp(std::floor(span.high * samples_per_unit + margin), 0.0, size - 2.0))) {}
  static constexpr double margin = 1e-6;
};

// The section of a horizontal line with a triangle; empty where it misses the triangle by rounding.
Span row_span(const CornerUv& corners, double v) {
  Span span;
  for (int k = 0; k < 3; ++k) {
    const Vec2d a = corners[k];
    const Vec2d b = corners[(k + 1) % 3];
    if (a.y == b.y) {
      if (a.y != v) continue;
      span.add(a.x);
      span.add(b.x);
      continue;
    }
    if (v < std::min(a.y, b.y) || v > std::max(a.y, b.y)) continue;
    span.add(a.x + (v - a.y) / (b.y - a.y) * (b.x - a.x));
  }
  return span;
}

// Whether a point is to the left of an edge, by exact arithmetic. A point on the edge is displaced
// by (e, e^2) for a vanishing e > 0: this decides its side consistently for both triangles of an
// edge and for all those around a vertex.
bool is_inside_edge(Vec2d a, Vec2d b, Vec2d point) {
  const int side = orientation(a, b, point);
  if (side != 0) return side > 0;
  return b.y < a.y || (b.y == a.y && b.x > a.x);
}

bool covers(const CornerUv& c, Vec2d point) {
  return is_inside_edge(c[0], c[1], point) && is_inside_edge(c[1], c[2], point) &&
         is_inside_edge(c[2], c[0], point);
}

/// The position of sample k of `size` along a side of the map's chart, were all at whole numbers.
double regular_place(int k, int size, int map_size) {
  return static_cast<double>(k) * (map_size - 1) / (size - 1);
}
Vec2d regular_place(int row, int col, ChartSize size, const SquareMap& map) {
  return {regular_place(col, size.cols, map.size.cols),
          regular_place(row, size.rows, map.size.rows)};
}

/// Interpolates the places of the samples around a regular place. Where one of them slid over the
/// cut, to a far part of the chart, it stays as it is.
Vec2d displaced(Vec2d regular, const SquareMap& map) {
  constexpr double max_slide = 8;
  const int row = std::min(static_cast<int>(regular.y), map.size.rows - 2),
            col = std::min(static_cast<int>(regular.x), map.size.cols - 2);
  const double v = regular.y - row, u = regular.x - col;
  Vec2d slide;
  double farthest = 0;
  for (const int r : {0, 1})
    for (const int c : {0, 1}) {
      const double weight = (r == 0 ? 1 - v : v) * (c == 0 ? 1 - u : u);
      if (weight == 0) continue;
      const Vec2d place =
          map.sample_places[static_cast<std::size_t>(row + r) * map.size.cols + col + c];
      if (weight == 1) return place;
      const Vec2d own = place - Vec2d{static_cast<double>(col + c), static_cast<double>(row + r)};
      slide = slide + weight * own;
      farthest = std::max(farthest, length(own));
    }
  return farthest <= max_slide ? regular + slide : regular;
}

struct DisplacedSample {
  int row = 0, col = 0;
  Vec2d place;
};

/// The interior samples of a grid that do not lie at their regular places, by the row of the map
/// that they lie in.
class DisplacedSamples {
 public:
  DisplacedSamples(const SquareMap& map, ChartSize size) {
    if (map.sample_places.empty()) return;
    by_row_.resize(static_cast<std::size_t>(map.size.rows));
    is_displaced_ = Grid<char>(size.rows, size.cols, 0);
    for (int row = 1; row < size.rows - 1; ++row)
      for (int col = 1; col < size.cols - 1; ++col) {
        const Vec2d place = sample_place(row, col, size, map);
        if (place == regular_place(row, col, size, map)) continue;
        is_displaced_(row, col) = 1;
        by_row_[static_cast<std::size_t>(place.y)].push_back({row, col, place});
      }
  }
  [[nodiscard]] bool has(int row, int col) const {
    return !by_row_.empty() && is_displaced_(row, col) != 0;
  }
  template <class Visit>
  void for_each_in(const Span& rows, const Span& cols, const Visit& visit) const {
    if (by_row_.empty()) return;
    const auto last =
        std::min(static_cast<std::size_t>(std::max(0.0, rows.high)), by_row_.size() - 1);
    for (auto row = static_cast<std::size_t>(std::max(0.0, rows.low)); row <= last; ++row)
      for (const DisplacedSample& sample : by_row_[row])
        if (sample.place.x >= cols.low && sample.place.x <= cols.high) visit(sample);
  }

 private:
  std::vector<std::vector<DisplacedSample>> by_row_;
  Grid<char> is_displaced_;
};

}  // namespace

CornerUv corner_uv(const SquareMap& map, const Triangle& triangle) {
  return {map.uv[triangle[0]], map.uv[triangle[1]], map.uv[triangle[2]]};
}

Vec2d sample_place(int row, int col, ChartSize size, const SquareMap& map) {
  const Vec2d regular = regular_place(row, col, size, map);
  return map.sample_places.empty() ? regular : displaced(regular, map);
}

void rasterise(const DiskMesh& disk, const SquareMap& map, ChartSize size,
               const std::function<void(int row, int col, int triangle)>& visit) {
  const double rows_per_unit = static_cast<double>(size.rows - 1) / (map.size.rows - 1);
  const double cols_per_unit = static_cast<double>(size.cols - 1) / (map.size.cols - 1);
  const DisplacedSamples displaced(map, size);
  for (std::size_t t = 0; t < disk.triangles.size(); ++t) {
    const CornerUv corners = corner_uv(map, disk.triangles[t]);
    Span rows, cols;
    for (const Vec2d uv : corners) {
      rows.add(uv.y);
      cols.add(uv.x);
    }
    const SampleRange row_range(rows, rows_per_unit, size.rows);
    for (int row = row_range.first; row <= row_range.last; ++row) {
      const double v = regular_place(row, size.rows, map.size.rows);
      const SampleRange col_range(row_span(corners, v), cols_per_unit, size.cols);
      for (int col = col_range.first; col <= col_range.last; ++col)
        if (covers(corners, {regular_place(col, size.cols, map.size.cols), v}) &&
            !displaced.has(row, col))
          visit(row, col, static_cast<int>(t));
    }
    displaced.for_each_in(rows, cols, [&](const DisplacedSample& sample) {
      if (covers(corners, sample.place)) visit(sample.row, sample.col, static_cast<int>(t));
    });
  }
}

std::array<double, 3> corner_weights(const CornerUv& corners, Vec2d point) {
  const Vec2d a = corners[0] - point;
  const Vec2d b = corners[1] - point;
  const Vec2d c = corners[2] - point;
  std::array<double, 3> weights{std::max(0.0, cross(b, c)), std::max(0.0, cross(c, a)),
                                std::max(0.0, cross(a, b))};
  const double sum = weights[0] + weights[1] + weights[2];
  if (!(sum > 0)) {  // a sliver whose area rounds to zero: the nearest corner
    const std::array<double, 3> d{dot(a, a), dot(b, b), dot(c, c)};
    weights.fill(0);
    weights[std::min_element(d.begin(), d.end()) - d.begin()] = 1;
    return weights;
  }
  for (double& w : weights) w /= sum;
  return weights;
}

}  // namespace weft
