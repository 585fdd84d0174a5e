#include "weft/param/stretch_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "weft/param/newton_system.h"

namespace weft {
namespace {

/// The smallest positive root s of d + b s + c s^2; infinity if there is none. @pre d > 0
double first_root(double c, double b, double d) {
  const double discriminant = b * b - 4 * c * d;
  if (discriminant < 0 || (b >= 0 && c >= 0)) return std::numeric_limits<double>::infinity();
  const double root = std::sqrt(discriminant);
  // 2 d / (-b + root) is the smallest positive root whatever the sign of c, without cancellation
  // for b < 0.
  const double divisor = root - b;
  return divisor > 0 ? 2 * d / divisor : std::numeric_limits<double>::infinity();
}

/// The step length at which the first triangle degenerates; infinity if none does.
double free_step_length(std::span<const Triangle> triangles, std::span<const Vec2d> uv,
                        std::span<const Vec2d> step) {
  double step_length = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : triangles) {
    const Vec2d p = uv[b] - uv[a];
    const Vec2d q = uv[c] - uv[a];
    const Vec2d dp = step[b] - step[a];
    const Vec2d dq = step[c] - step[a];
    step_length =
        std::min(step_length, first_root(cross(dp, dq), cross(p, dq) + cross(dp, q), cross(p, q)));
  }
  return step_length;
}

/// A map under minimisation.
struct State {
  const DiskGeometry& geometry;
  std::span<const BorderFreedom> freedoms;
  std::span<Vec2d> uv;
  double energy = 0;
};

/// The map after a step of the given length, freedoms on the grid of snap_to_grid.
std::vector<Vec2d> moved(const State& state, const NewtonSystem::Step& step, double step_length) {
  std::vector<Vec2d> uv(state.uv.begin(), state.uv.end());
  for (std::size_t v = 0; v < uv.size(); ++v) uv[v] = uv[v] + step_length * step.move[v];
  snap_to_grid(state.freedoms, uv);
  return uv;
}

/// Backtracking line search with sufficient decrease; without one the map is unchanged. The
/// projected Hessian is too stiff along valleys, so the step length is doubled while the energy
/// falls if the first trial is accepted.
void line_search(State& state, const NewtonSystem::Step& step) {
  const double max = 0.9 * free_step_length(state.geometry.disk.triangles, state.uv, step.move);
  double step_length = std::min(1.0, max);
  const auto lowers = [&](double reached) {
    return reached <= state.energy + 1e-4 * step_length * step.slope;
  };
  for (int halving = 0; halving < 12; ++halving, step_length *= 0.5) {
    std::vector<Vec2d> trial = moved(state, step, step_length);
    double reached = state.geometry.energy(trial);
    if (!lowers(reached)) continue;
    while (halving == 0 && 2 * step_length < max) {
      std::vector<Vec2d> further = moved(state, step, 2 * step_length);
      const double energy = state.geometry.energy(further);
      if (!(energy < reached)) break;
      step_length *= 2;
      reached = energy;
      trial = std::move(further);
    }
    if (!is_valid_map(state.geometry.disk.triangles, trial)) continue;
    std::copy(trial.begin(), trial.end(), state.uv.begin());
    state.energy = reached;
    return;
  }
}

}  // namespace

void minimise_by_newton(const DiskGeometry& geometry, std::span<Vec2d> uv,
                        const NewtonOptions& options) {
  NewtonSystem system(geometry, options.freedoms);
  State state{geometry, options.freedoms, uv, geometry.energy(uv)};
  for (int step = 0; step < options.steps; ++step) {
    update(options.progress, "map", static_cast<double>(step) / options.steps);
    const NewtonSystem::Step newton = system.solve(uv);
    if (newton.move.empty()) return;
    const double before = state.energy;
    line_search(state, newton);
    // Stretch scales with the root of the energy, so its relative decrease is half as large.
    if (state.energy > before * (1 - 2 * options.min_gain)) return;
  }
}

}  // namespace weft
