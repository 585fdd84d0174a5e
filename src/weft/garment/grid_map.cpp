#include "weft/garment/grid_map.h"

#include <algorithm>
#include <cmath>

#include "weft/core/quasi_newton.h"
#include "weft/garment/grid_energy.h"

namespace weft {
namespace {

constexpr int steps_a_round = 80, max_rounds = 40;
/// A round that lowers the energy by less than this part of it, with nothing folded, is the last.
constexpr double settled = 1e-3;
/// Coarse grids have at least so many samples a side, and the coarsest no more than this.
constexpr int min_coarse_side = 16, max_coarse_side = 64;

/// Lowers the energy. @return it
double descend(const GridEnergy& energy, PlaneGrid& grid, Progress* progress) {
  constexpr double first_step = 0.1, still = 1e-7;
  PlaneGrid trial = grid;
  const auto measure = [&](const Vectors& points, Vectors& gradient) {
    update(progress, "", 0);
    trial.points = points;
    return energy.measure(trial, gradient);
  };
  return descend(measure, grid.points,
                 {steps_a_round, first_step * length(grid.at(0, 1) - grid.at(0, 0)), still});
}

void unfold(PlaneGrid& grid, int rounds, Progress* progress) {
  GridEnergy measure(grid, GridEnergy::Cell::as_border);
  double before = HUGE_VAL;
  for (int round = 0; round < rounds; ++round) {
    const double folded = std::min(0.0, measure.min_area(grid));
    measure.set_epsilon(1e-12 + 0.04 * folded * folded);
    const double energy = descend(measure, grid, progress);
    if (folded == 0 && before - energy < settled * energy) return;
    before = folded == 0 ? energy : HUGE_VAL;
  }
}

/// The border of a grid of all its samples.
struct FineBorder {
  const Vectors& points;
  int rows = 0, cols = 0;
};

/// Takes as many samples of each side as the grid has, evenly.
void place_border(PlaneGrid& grid, const FineBorder& fine) {
  const int right = grid.cols - 1, up = grid.rows - 1;
  const int fine_right = fine.cols - 1, fine_up = fine.rows - 1;
  const int opposite = fine_right + fine_up, count = 2 * opposite;
  const auto at = [&](int place) { return fine.points[place % count]; };
  for (int c = 0; c < right; ++c) {
    const int along = c * fine_right / right;
    grid.at(0, c) = at(along);
    grid.at(up, right - c) = at(opposite + along);
  }
  for (int r = 0; r < up; ++r) {
    const int along = r * fine_up / up;
    grid.at(r, right) = at(fine_right + along);
    grid.at(up - r, 0) = at(opposite + fine_right + along);
  }
}

/// The sum of both ways of filling in between opposite sides, less what both have. [coons67]
void fill_inside(PlaneGrid& grid) {
  const int right = grid.cols - 1, up = grid.rows - 1;
  for (int r = 1; r < up; ++r)
    for (int c = 1; c < right; ++c) {
      const double u = static_cast<double>(c) / right, v = static_cast<double>(r) / up;
      grid.at(r, c) = (1 - v) * grid.at(0, c) + v * grid.at(up, c) + (1 - u) * grid.at(r, 0) +
                      u * grid.at(r, right) - (1 - u) * (1 - v) * grid.at(0, 0) -
                      u * (1 - v) * grid.at(0, right) - (1 - u) * v * grid.at(up, 0) -
                      u * v * grid.at(up, right);
    }
}

/// Where a place between two others lies: after how many intervals, and which part of the next.
struct Place {
  int before = 0;
  double part = 0;
  Place(int k, int intervals, int coarse_intervals)
      : before(k * coarse_intervals / intervals),
        part(static_cast<double>(k * coarse_intervals % intervals) / intervals) {}
};

/// Fills in between the points of a coarser grid.
void refine_inside(PlaneGrid& grid, const PlaneGrid& coarse) {
  for (int r = 1; r + 1 < grid.rows; ++r)
    for (int c = 1; c + 1 < grid.cols; ++c) {
      const Place v(r, grid.rows - 1, coarse.rows - 1), u(c, grid.cols - 1, coarse.cols - 1);
      const auto in_row = [&](int row) {
        return (1 - u.part) * coarse.at(row, u.before) + u.part * coarse.at(row, u.before + 1);
      };
      grid.at(r, c) = (1 - v.part) * in_row(v.before) + v.part * in_row(v.before + 1);
    }
}

/// Samples of a side of the next coarser grid.
int coarser(int samples) { return (samples - 1) / 2 + 1; }

/// A grid of so many samples, of which the border is placed.
PlaneGrid bordered(const FineBorder& fine, int rows, int cols) {
  PlaneGrid grid{rows, cols, {}};
  grid.points.resize(static_cast<std::size_t>(rows) * cols);
  place_border(grid, fine);
  return grid;
}

bool is_coarsest(int rows, int cols) {
  return std::min(rows, cols) < min_coarse_side || std::max(rows, cols) <= max_coarse_side;
}

/// Spreads grids from coarse to fine, each from the one before.
PlaneGrid spread(const FineBorder& fine, int rows, int cols, Progress* progress) {
  PlaneGrid grid = bordered(fine, rows, cols);
  if (is_coarsest(rows, cols))
    fill_inside(grid);
  else
    refine_inside(grid, spread(fine, coarser(rows), coarser(cols), progress));
  unfold(grid, max_rounds, progress);
  return grid;
}

}  // namespace

bool PlaneGrid::unfolded() const {
  const auto left = [](Vec2d a, Vec2d b, Vec2d c) { return cross(b - a, c - a) > 0; };
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c + 1 < cols; ++c) {
      const Vec2d a = at(r, c), b = at(r, c + 1), d = at(r + 1, c), e = at(r + 1, c + 1);
      if (!(left(a, b, e) && left(a, e, d)) && !(left(a, b, d) && left(b, e, d))) return false;
    }
  return true;
}

std::optional<PlaneGrid> spread_inside(const std::vector<Vec2d>& border, int rows, int cols,
                                       Progress* progress) {
  PlaneGrid grid = spread({border, rows, cols}, rows, cols, progress);
  if (!grid.unfolded()) return std::nullopt;
  return grid;
}

double spread_cost(const std::vector<Vec2d>& border, int rows, int cols, Progress* progress) {
  constexpr int few_rounds = 4;
  const FineBorder fine{border, rows, cols};
  do {
    rows = coarser(rows);
    cols = coarser(cols);
  } while (!is_coarsest(rows, cols));
  PlaneGrid grid = bordered(fine, rows, cols);
  fill_inside(grid);
  unfold(grid, few_rounds, progress);
  const GridEnergy measure(grid, GridEnergy::Cell::square);
  if (!(measure.min_area(grid) > 0)) return HUGE_VAL;
  Vectors gradient(grid.points.size());
  return measure.measure(grid, gradient) / (4.0 * (grid.rows - 1) * (grid.cols - 1));
}

}  // namespace weft
