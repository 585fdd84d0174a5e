#include "weft/garment/grid_map.h"

#include <algorithm>
#include <cmath>

#include "weft/garment/grid_energy.h"
#include "weft/garment/quasi_newton.h"

namespace weft {
namespace {

constexpr int steps_a_round = 80, max_rounds = 40, max_halvings = 30;
/// A round that lowers the energy by less than this part of it, with nothing folded, is the last.
constexpr double settled = 1e-3;

/// The part of a direction that moves no point by more than a tenth of a typical side.
double first_length(const PlaneGrid& grid, const Vectors& direction) {
  const Vec2d side = grid.at(0, 1) - grid.at(0, 0);
  double most = 0;
  for (const Vec2d& v : direction) most = std::max(most, std::hypot(v.x, v.y));
  return 0.1 * std::hypot(side.x, side.y) / most;
}

/// Lowers the energy. @return it
double descend(const GridEnergy& measure, PlaneGrid& grid) {
  Vectors gradient(grid.points.size()), next_gradient(grid.points.size());
  double energy = measure.measure(grid, gradient);
  QuasiNewton method;
  for (int step = 0; step < steps_a_round; ++step) {
    const Vectors direction = method.direction(gradient);
    const double slope = dot_of(direction, gradient);
    if (!(slope > 0)) break;
    double length = method.knows_nothing() ? first_length(grid, direction) : 1;
    PlaneGrid trial = grid;
    double lower = energy;
    int halvings = 0;
    for (; halvings < max_halvings; ++halvings, length *= 0.5) {
      trial.points = grid.points;
      add_scaled(trial.points, -length, direction);
      lower = measure.measure(trial, next_gradient);
      if (lower <= energy - 1e-4 * length * slope) break;
    }
    if (halvings == max_halvings) {
      if (method.knows_nothing()) break;
      method.forget();
      continue;
    }
    Vectors moved = trial.points, turned = next_gradient;
    add_scaled(moved, -1, grid.points);
    add_scaled(turned, -1, gradient);
    method.learn(std::move(moved), std::move(turned));
    const bool still = energy - lower < 1e-7 * energy;
    grid = std::move(trial);
    gradient = next_gradient;
    energy = lower;
    if (still) break;
  }
  return energy;
}

void unfold(PlaneGrid& grid, const int rounds = max_rounds) {
  GridEnergy measure(grid, GridEnergy::Cell::as_border);
  double before = HUGE_VAL;
  for (int round = 0; round < rounds; ++round) {
    const double folded = std::min(0.0, measure.least_area(grid));
    measure.set_epsilon(1e-12 + 0.04 * folded * folded);
    const double energy = descend(measure, grid);
    if (folded == 0 && before - energy < settled * energy) return;
    before = folded == 0 ? energy : HUGE_VAL;
  }
}

void place_border(PlaneGrid& grid, const Vectors& border, int stride) {
  const int right = grid.cols - 1, up = grid.rows - 1;
  std::size_t k = 0;
  const auto next = [&] { return border[stride * k++]; };
  for (int c = 0; c < right; ++c) grid.at(0, c) = next();
  for (int r = 0; r < up; ++r) grid.at(r, right) = next();
  for (int c = right; c > 0; --c) grid.at(up, c) = next();
  for (int r = up; r > 0; --r) grid.at(r, 0) = next();
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

/// Fills in between the points of a grid of half as many cells.
void refine_inside(PlaneGrid& grid, const PlaneGrid& coarse) {
  for (int r = 1; r + 1 < grid.rows; ++r)
    for (int c = 1; c + 1 < grid.cols; ++c) {
      const int r1 = (r + 1) / 2, c1 = (c + 1) / 2;
      grid.at(r, c) = 0.25 * (coarse.at(r / 2, c / 2) + coarse.at(r1, c / 2) +
                              coarse.at(r / 2, c1) + coarse.at(r1, c1));
    }
}

PlaneGrid coarse_grid(const Vectors& border, int rows, int cols, int rounds) {
  PlaneGrid coarse{rows / 2 + 1, cols / 2 + 1, {}};
  coarse.points.resize(static_cast<std::size_t>(coarse.rows) * coarse.cols);
  place_border(coarse, border, 2);
  fill_inside(coarse);
  unfold(coarse, rounds);
  return coarse;
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

std::optional<PlaneGrid> spread_inside(const std::vector<Vec2d>& border, int rows, int cols) {
  const PlaneGrid coarse = coarse_grid(border, rows, cols, max_rounds);
  PlaneGrid grid{rows, cols, {}};
  grid.points.resize(static_cast<std::size_t>(rows) * cols);
  place_border(grid, border, 1);
  refine_inside(grid, coarse);
  unfold(grid);
  if (!grid.unfolded()) return std::nullopt;
  return grid;
}

double spread_cost(const std::vector<Vec2d>& border, int rows, int cols) {
  constexpr int few_rounds = 4;
  const PlaneGrid grid = coarse_grid(border, rows, cols, few_rounds);
  const GridEnergy measure(grid, GridEnergy::Cell::square);
  if (!(measure.least_area(grid) > 0)) return HUGE_VAL;
  Vectors gradient(grid.points.size());
  return measure.measure(grid, gradient) / (4.0 * (grid.rows - 1) * (grid.cols - 1));
}

}  // namespace weft
