#include "weft/param/local_newton.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "weft/param/vertex_star.h"

namespace weft {
namespace {

/// [V] the group of each inner vertex, -1 of others.
std::vector<int> groups_of(const CollapseHierarchy& mesh) {
  std::vector<int> group(mesh.vertex_count(), -1);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_inner(v)) continue;
    int last = -1;
    mesh.around(v, [&](int h) {
      if (mesh.to(h) < v) last = std::max(last, group[mesh.to(h)]);
    });
    group[v] = last + 1;
  }
  return group;
}

/// Steps with a smaller predicted relative decrease are not tried.
constexpr double min_gain = 1e-8;

/// Doubles a full step while each doubling lowers the energy by much: next to an almost degenerate
/// triangle Newton steps are far too short.
double longer_step_length(const VertexStar& star, Vec2d place, Vec2d step, double max) {
  constexpr double much = 0.7;
  double step_length = 1;
  double last = star.energy(place);
  double reached = star.energy(place + step);
  while (reached < much * last && step_length < max) {
    const double next = std::min(2 * step_length, max);
    last = reached;
    reached = star.energy(place + next * step);
    if (!(reached < last)) break;
    step_length = next;
  }
  return step_length;
}

Vec2d on_axis(int axis, double length) { return axis == 0 ? Vec2d{length, 0} : Vec2d{0, length}; }

}  // namespace

SweepSchedule schedule_sweep(const CollapseHierarchy& mesh) {
  SweepSchedule schedule;
  const std::vector<int> group = groups_of(mesh);
  if (group.empty()) return schedule;
  schedule.first.assign(*std::max_element(group.begin(), group.end()) + 2, 0);
  for (const int g : group)
    if (g >= 0) ++schedule.first[g + 1];
  for (int g = 0; g < schedule.group_count(); ++g) schedule.first[g + 1] += schedule.first[g];
  schedule.vertices.resize(schedule.first.back());
  std::vector<int> next(schedule.first.begin(), schedule.first.end() - 1);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (group[v] < 0) continue;
    schedule.vertices[next[group[v]]++] = v;
    schedule.largest_valence = std::max(schedule.largest_valence, mesh.valence(v));
  }
  return schedule;
}

VertexMover::VertexMover(const CollapseHierarchy& mesh, std::span<const StarTriangle> triangles,
                         std::span<Vec2d> uv, int threads)
    : mesh_(mesh), triangles_(triangles), uv_(uv), stars_(threads) {
  if (threads > 1) team_ = std::make_unique<ThreadTeam>(threads);
}

double VertexMover::improve(int vertex, VertexStar& star) {
  star.gather(mesh_, triangles_, uv_, vertex);
  const Vec2d place = uv_[vertex];
  const VertexStar::Model here = star.model(place);
  const Symmetric2& curvature = here.hessian.is_positive() ? here.hessian : here.squares;
  const Vec2d step = curvature.solve(-1.0 * here.gradient);
  const double slope = dot(step, here.gradient);
  if (!std::isfinite(here.energy) || !(slope < -min_gain * here.energy)) return 0;
  const double max = 0.9 * star.free_step_length(place, step);
  double step_length = std::min(1.0, max);
  for (int halving = 0; halving < 8; ++halving, step_length *= 0.5) {
    const double reached = star.energy(place + step_length * step);
    if (!(reached < here.energy + 1e-4 * step_length * slope)) continue;
    if (step_length == 1 && reached < 0.7 * here.energy)
      step_length = longer_step_length(star, place, step, max);
    if (!star.is_valid(place + step_length * step)) continue;
    uv_[vertex] = place + step_length * step;
    return 1 - reached / here.energy;
  }
  return 0;
}

bool VertexMover::centre(int vertex) {
  stars_[0].gather(mesh_, triangles_, uv_, vertex);
  const std::optional<Vec2d> place = kernel_point(stars_[0].ring());
  if (!place || !(stars_[0].energy(*place) < stars_[0].energy(uv_[vertex]))) return false;
  uv_[vertex] = *place;
  return true;
}

bool VertexMover::improve(const BorderFreedom& freedom) {
  const std::array<int, 2> vertex = {freedom.vertex, freedom.mate};
  const std::array<VertexStar*, 2> star = {&stars_[0], &mate_star_};
  const std::array<Vec2d, 2> direction = {on_axis(freedom.axis, 1),
                                          on_axis(freedom.mate_axis, freedom.sign)};
  const int ends = freedom.mate >= 0 ? 2 : 1;
  std::array<Vec2d, 2> before{};
  double energy = 0, slope = 0, hessian = 0, squares = 0;
  for (int k = 0; k < ends; ++k) {
    before[k] = uv_[vertex[k]];
    star[k]->gather(mesh_, triangles_, uv_, vertex[k]);
    const VertexStar::Model here = star[k]->model(before[k]);
    energy += here.energy;
    slope += dot(here.gradient, direction[k]);
    hessian += here.hessian.along(direction[k]);
    squares += here.squares.along(direction[k]);
  }
  double step = -slope / (hessian > 0 ? hessian : squares);
  if (!std::isfinite(energy) || !(slope * step < -min_gain * energy)) return false;
  for (int k = 0; k < ends; ++k) {
    const double sign = step > 0 ? 1 : -1;
    const double max = 0.9 * star[k]->free_step_length(before[k], sign * direction[k]);
    step = std::clamp(step, -max, max);
  }
  for (int halving = 0; halving < 8; ++halving, step *= 0.5) {
    uv_[freedom.vertex] = before[0] + step * direction[0];
    snap_to_grid(std::span(&freedom, 1), uv_);
    double reached = 0;
    bool valid = true;
    for (int k = 0; k < ends; ++k) {
      reached += star[k]->energy(uv_[vertex[k]]);
      valid = valid && star[k]->is_valid(uv_[vertex[k]]);
    }
    if (valid && reached < energy) return true;
  }
  for (int k = 0; k < ends; ++k) uv_[vertex[k]] = before[k];
  return false;
}

void VertexMover::plan_sweeps() {
  constexpr int min_vertices = 2000;  // below, waiting for each other takes longer than the work
  constexpr int min_width = 40;
  schedule_ = {};
  if (!team_ || mesh_.triangle_count() < 2 * min_vertices) return;
  schedule_ = schedule_sweep(mesh_);
  const auto count = static_cast<int>(schedule_.vertices.size());
  if (count < min_width * schedule_.group_count()) schedule_ = {};
  for (VertexStar& star : stars_) star.reserve(schedule_.largest_valence);
}

/// Visits inner vertices as in ascending order. @param alone  without the help of other threads
template <class Visit>
void VertexMover::for_each_inner(bool alone, const Visit& visit) {
  if (alone || schedule_.vertices.empty()) {
    for (int v = 0; v < mesh_.vertex_count(); ++v)
      if (mesh_.is_inner(v)) visit(v, stars_[0]);
    return;
  }
  team_->run([&](Worker& worker) {
    for (int g = 0; g < schedule_.group_count(); ++g) {
      const Range mine = worker.share(schedule_.first[g + 1] - schedule_.first[g]);
      for (int i = mine.first; i < mine.last; ++i)
        visit(schedule_.vertices[schedule_.first[g] + i], stars_[worker.rank()]);
      worker.barrier();
    }
  });
}

void VertexMover::sweep(int times, std::span<const BorderFreedom> freedoms) {
  plan_sweeps();
  for (int k = 0; k < times; ++k) {
    for_each_inner(false, [&](int v, VertexStar& star) { improve(v, star); });
    for (const BorderFreedom& freedom : freedoms) improve(freedom);
  }
}

/// Wakes the vertices that moved far and their neighbours. @return how many moved far
int VertexMover::wake() {
  awake_.assign(mesh_.vertex_count(), 0);
  int count = 0;
  for (int v = 0; v < mesh_.vertex_count(); ++v) {
    if (!moved_far_[v]) continue;
    ++count;
    awake_[v] = 1;
    mesh_.around(v, [&](int h) { awake_[mesh_.to(h)] = 1; });
  }
  return count;
}

void VertexMover::sweep_restless(int max, std::span<const BorderFreedom> freedoms) {
  constexpr double far = 1e-3;   // share of the energy around a vertex that its turn took away
  constexpr int min_share = 16;  // a smaller part of all vertices does not pay for the barriers
  plan_sweeps();
  moved_far_.assign(mesh_.vertex_count(), 0);
  awake_.assign(mesh_.vertex_count(), 1);
  int moved = mesh_.vertex_count();
  for (int k = 0; k < max && moved > 0; ++k) {
    for_each_inner(moved < mesh_.vertex_count() / min_share, [&](int v, VertexStar& star) {
      moved_far_[v] = awake_[v] && improve(v, star) > far ? 1 : 0;
    });
    for (const BorderFreedom& freedom : freedoms) improve(freedom);
    moved = wake();
  }
}

}  // namespace weft
