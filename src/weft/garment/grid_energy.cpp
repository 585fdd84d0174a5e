#include "weft/garment/grid_energy.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {
namespace {

double distance(Vec2d a, Vec2d b) { return length(b - a); }

/// Sine of the angle at a corner of the grid up to which the outline counts as straight there: its
/// cell cannot have an area at that corner.
constexpr double straight = 0.2;

}  // namespace

GridEnergy::GridEnergy(const PlaneGrid& grid, Cell cell) {
  const int last_row = grid.rows - 1, last_col = grid.cols - 1;
  double along_u = 0, along_v = 0, area = 0;
  const auto add = [&](Vec2d a, Vec2d b, double& length) {
    length += 0.5 * distance(a, b);
    area += 0.5 * cross(a, b);
  };
  for (int c = 0; c < last_col; ++c) {
    add(grid.at(0, c), grid.at(0, c + 1), along_u);
    add(grid.at(last_row, c + 1), grid.at(last_row, c), along_u);
  }
  for (int r = 0; r < last_row; ++r) {
    add(grid.at(r, last_col), grid.at(r + 1, last_col), along_v);
    add(grid.at(r + 1, 0), grid.at(r, 0), along_v);
  }
  const double scale = std::sqrt(std::abs(area) / (along_u * along_v));
  per_u_ = last_col / (scale * along_u);
  per_v_ = last_row / (scale * along_v);
  if (cell == Cell::square) per_u_ = per_v_ = std::sqrt(per_u_ * per_v_);
  for (const int r : {0, 1})
    for (const int c : {0, 1}) {
      const int row = r * last_row, col = c * last_col;
      const int left = c * (last_col - 1), low = r * (last_row - 1);
      const Vec2d a = grid.at(row, left + 1) - grid.at(row, left);
      const Vec2d b = grid.at(low + 1, col) - grid.at(low, col);
      corner_counts_[r][c] = cross(a, b) > straight * length(a) * length(b);
    }
}

template <class Use>
void GridEnergy::for_pairs(const PlaneGrid& grid, const Use& use) const {
  for (int r = 0; r + 1 < grid.rows; ++r)
    for (int c = 0; c + 1 < grid.cols; ++c)
      for (const int up : {0, 1})
        for (const int right : {0, 1}) {
          const int row = r + up, col = c + right;
          const bool corner =
              (row == 0 || row == grid.rows - 1) && (col == 0 || col == grid.cols - 1);
          if (corner && !corner_counts_[up][right]) continue;
          const std::size_t a = static_cast<std::size_t>(row) * grid.cols + c;
          const std::size_t b = static_cast<std::size_t>(r) * grid.cols + col;
          use(a, b, per_u_ * (grid.points[a + 1] - grid.points[a]),
              per_v_ * (grid.points[b + grid.cols] - grid.points[b]));
        }
}

double GridEnergy::measure(const PlaneGrid& grid, std::vector<Vec2d>& gradient) const {
  std::fill(gradient.begin(), gradient.end(), Vec2d{});
  double energy = 0;
  for_pairs(grid, [&](std::size_t first_u, std::size_t first_v, Vec2d a, Vec2d b) {
    const double area = cross(a, b), root = std::sqrt(squared_epsilon_ + area * area);
    // For folded cells the sum would cancel.
    const double bound =
        area > 0 ? 0.5 * (area + root) : 0.5 * squared_epsilon_ / std::max(root - area, 1e-300);
    const double value = (dot(a, a) + dot(b, b) + area * area + 1) / bound;
    energy += value;
    const double slope = bound / root;  // of the bound by the area
    const double by_area = (2 * area - value * slope) / bound, by_side = 2 / bound;
    const Vec2d by_a = per_u_ * (by_side * a + by_area * Vec2d{b.y, -b.x});
    const Vec2d by_b = per_v_ * (by_side * b + by_area * Vec2d{-a.y, a.x});
    gradient[first_u + 1] = gradient[first_u + 1] + by_a;
    gradient[first_u] = gradient[first_u] - by_a;
    gradient[first_v + grid.cols] = gradient[first_v + grid.cols] + by_b;
    gradient[first_v] = gradient[first_v] - by_b;
  });
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.cols; ++c)
      if (r == 0 || c == 0 || r + 1 == grid.rows || c + 1 == grid.cols)
        gradient[static_cast<std::size_t>(r) * grid.cols + c] = {};
  return energy;
}

double GridEnergy::min_area(const PlaneGrid& grid) const {
  double least = HUGE_VAL;
  for_pairs(grid, [&](std::size_t, std::size_t, Vec2d a, Vec2d b) {
    least = std::min(least, cross(a, b));
  });
  return least;
}

}  // namespace weft
