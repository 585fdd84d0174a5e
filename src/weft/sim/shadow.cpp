#include "weft/sim/shadow.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "weft/vec.h"

namespace weft {
namespace {

constexpr int side = 2048;

/// A raster over a square around the surface; a pixel is covered when its centre is.
class Raster {
 public:
  Raster(Vec2d lower, double width)
      : lower_(lower), pixel_(width / side), covered_(std::size_t{side} * side, 0) {}

  void fill(Vec2d a, Vec2d b, Vec2d c) {
    const Vec2d p = place(a), q = place(b), r = place(c);
    const int first = std::max(0, ceiling(std::min({p.y, q.y, r.y})));
    const int last = std::min(side - 1, floor_of(std::max({p.y, q.y, r.y})));
    for (int row = first; row <= last; ++row) fill_row(row, p, q, r);
  }

  [[nodiscard]] double area() const {
    const auto count = std::count(covered_.begin(), covered_.end(), 1);
    return static_cast<double>(count) * pixel_ * pixel_;
  }

 private:
  /// Converts to pixel coordinates, with pixel centres at whole numbers.
  [[nodiscard]] Vec2d place(Vec2d at) const {
    return {(at.x - lower_.x) / pixel_ - 0.5, (at.y - lower_.y) / pixel_ - 0.5};
  }
  static int ceiling(double x) { return static_cast<int>(std::ceil(x)); }
  static int floor_of(double x) { return static_cast<int>(std::floor(x)); }

  /// Covers the pixels of a row whose centres lie in the triangle.
  void fill_row(int row, Vec2d p, Vec2d q, Vec2d r) {
    double from = side, to = -1;
    const auto cross_edge = [&](Vec2d a, Vec2d b) {
      if (std::min(a.y, b.y) > row || std::max(a.y, b.y) < row) return;
      const double part = a.y == b.y ? 0 : (row - a.y) / (b.y - a.y);
      const double x = a.x + part * (b.x - a.x);
      from = std::min({from, x, a.y == b.y ? b.x : x});
      to = std::max({to, x, a.y == b.y ? b.x : x});
    };
    cross_edge(p, q);
    cross_edge(q, r);
    cross_edge(r, p);
    const int first = std::max(0, ceiling(from)), last = std::min(side - 1, floor_of(to));
    if (first > last) return;
    const auto start = covered_.begin() + std::ptrdiff_t{row} * side;
    std::fill(start + first, start + last + 1, 1);
  }

  Vec2d lower_;
  double pixel_;
  std::vector<unsigned char> covered_;
};

Vec2d from_above(const Planes3& position, int row, int col) {
  const Vec3d p = vec_cast<double>(position.at(row, col));
  return {p.x, p.z};
}

}  // namespace

double shadow_area(const Planes3& position) {
  const int n = position.size();
  Vec2d lower = from_above(position, 0, 0), upper = lower;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const Vec2d p = from_above(position, r, c);
      lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
      upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
    }
  const double width = std::max(upper.x - lower.x, upper.y - lower.y);
  if (!(width > 0)) return 0;
  Raster raster(lower, width);
  for (int r = 0; r + 1 < n; ++r)
    for (int c = 0; c + 1 < n; ++c) {
      const Vec2d a = from_above(position, r, c), b = from_above(position, r, c + 1);
      const Vec2d d = from_above(position, r + 1, c), e = from_above(position, r + 1, c + 1);
      raster.fill(a, b, e);
      raster.fill(a, e, d);
    }
  return raster.area();
}

}  // namespace weft
