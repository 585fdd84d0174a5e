#include <algorithm>
#include <cmath>
#include <utility>

#include "weft/collide/contact_pipeline.h"

namespace weft {
namespace {

/// Points that were held back or moved far may lead others astray, so all is looked at again. In
/// the first rounds points may be moved far aside, which leaves them their motion along what they
/// meet; in the next ones they are held back on their way.
constexpr int rounds_aside = 4, rounds_on_the_way = 6;
/// Then whoever is stopped takes refuge with all around it, in squares that double from round
/// to round; at last the cloths do as a whole.
constexpr int max_rounds = 14;
/// SafePositions go along with bodies that moved onto points; how far around them doubles, too:
/// twice this many rest spacings at first, the nearest part of them wholly.
constexpr double min_spread = 4, max_spread = 64, carried_in_spreads = 0.25;
/// Up to this one they leave cloth its way along bodies.
constexpr double max_sliding_spread = 16;
/// What stands still holds them back, so near.
constexpr double held_in_spacings = 4;
/// Paths that stay farther apart than this part of the slack do not cross, nor do they by rounding.
constexpr double touching = 0.01;
/// Before the ground, against rounding [m].
constexpr double ground_margin = 2e-6;

enum Fate : char { free_point, moved_point, stopped_point, fallen_point };

}  // namespace

PlaneSide ContactPipeline::side_of(std::size_t surface) const {
  const bool body = surface >= cloths_.size();
  return {surfaces_[surface], body ? 0 : cloths_[surface].first_point, body,
          body ? surfaces_[surface].end : cloths_[surface].safe_position,
          body ? nullptr : cloths_[surface].new_cells.data()};
}

void ContactPipeline::put_end(const MovingCloth& cloth, int point, Vec3f end) {
  const int sample = point - cloths_[cloth_of_[point]].first_point;
  if (cloth.position.at(sample) == end) return;
  cloth.position.set(sample, end);
  new_points_[point] = 1;
}

void ContactPipeline::drop_old_planes() {
  planes_.resize(ground_planes_);
  std::erase_if(planes_, [&](const SeparatingPlane& plane) {
    const auto first = plane.points.begin();
    return std::any_of(first, first + plane.count_a + plane.count_b,
                       [&](int point) { return new_points_[point] != 0; });
  });
}

void ContactPipeline::mark_new_cells() {
  for (PipelineCloth& one : cloths_) {
    const int n = one.properties.size, cells = n - 1;
    one.new_cells.assign(static_cast<std::size_t>(cells) * cells, 0);
    for (int s = 0; s < n * n; ++s) {
      if (new_points_[one.first_point + one.grid.point(s)] == 0) continue;
      for (int r = std::max(0, s / n - 1); r <= std::min(cells - 1, s / n); ++r)
        for (int c = std::max(0, s % n - 1); c <= std::min(cells - 1, s % n); ++c)
          one.new_cells[static_cast<std::size_t>(r) * cells + c] = 1;
    }
  }
}

void ContactPipeline::find_planes(bool all, ThreadTeam& team) {
  if (all) {
    planes_.clear();
  } else {
    drop_old_planes();
    mark_new_cells();
  }
  add_planes(all, 2 * slack_, team);
}

void ContactPipeline::add_planes(bool all, double farthest, ThreadTeam& team) {
  const float reach = static_cast<float>(farthest), slack = static_cast<float>(slack_);
  for (std::size_t i = 0; i < cloths_.size(); ++i)
    for (std::size_t j = i; j < surfaces_.size(); ++j) {
      if (i == j && !cloths_[i].properties.self_collision) continue;
      const int first = static_cast<int>(i), second = static_cast<int>(j);
      const std::span<const CandidatePair> cells =
          i == j ? pairs_->find_self(first, reach, slack, team)
                 : pairs_->find(first, second, reach, team);
      PlaneSearch search{side_of(i), side_of(j), i == j, {slack_, carried_}};
      if (!all) search.new_points = new_points_.data();
      if (!search.b.body) search.tangle = untangler_.marks(i, j);
      if (search.b.body) {
        search.inside = &cloths_[i].body_contacts->inside();
        search.body_number = static_cast<int>(j - cloths_.size()) + 1;
      }
      cell_planes_.find(search, cells, team, planes_);
    }
}

void ContactPipeline::add_ground_planes(std::span<const MovingCloth> cloths) {
  ground_planes_ = planes_.size();
  if (!ground_) return;
  const double least = ground_->height + ground_margin;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    const PipelineCloth& one = cloths_[i];
    for (int s = 0; s < one.properties.size * one.properties.size; ++s) {
      if (one.grid.point(s) != s || cloths[i].position.at(s).y >= least + slack_ ||
          cloths[i].start.at(s).y < least)
        continue;
      SeparatingPlane plane;
      plane.normal = plane.turned = {0, 1, 0};
      plane.at_end.a = plane.still.a = least;
      plane.points[0] = one.first_point + s;
      plane.count_a = 1;
      planes_.push_back(plane);
    }
  }
}

FilteredPoint ContactPipeline::point_at(std::span<const MovingCloth> cloths, int point) const {
  const std::size_t cloth = cloth_of_[point];
  const int sample = point - cloths_[cloth].first_point;
  return {cloths[cloth].start.at(sample), cloths_[cloth].safe_position->at(sample),
          cloths[cloth].position.at(sample)};
}

/// Whether all points may go where they go: planes are needed only between what touches on its way,
/// as long as none of them moves a point.
bool ContactPipeline::all_pass(std::span<const MovingCloth> cloths, ThreadTeam& team) {
  if (needs_boxes()) pairs_->refit(surfaces_, team);
  planes_.clear();
  add_planes(true, touching * slack_, team);
  add_ground_planes(cloths);
  return plane_filter_.all_satisfied(
      planes_, points_, [&](int point) { return point_at(cloths, point); }, team);
}

SeparatingPlaneFilter::Result ContactPipeline::hold(std::span<const MovingCloth> cloths,
                                                    double farthest, ThreadTeam& team) {
  const auto at = [&](int point) { return point_at(cloths, point); };
  const auto put = [&](int point, Vec3f end) {
    const std::size_t cloth = cloth_of_[point];
    put_end(cloths[cloth], point, end);
    fates_[point] = std::max<char>(fates_[point], moved_point);
  };
  const SeparatingPlaneFilter::Result held =
      plane_filter_.hold(planes_, points_, {slack_, farthest}, at, put, team);
  for (const int point : plane_filter_.stopped())
    fates_[point] = std::max<char>(fates_[point], stopped_point);
  return held;
}

void ContactPipeline::fall_back_to_safe_positions(std::span<const MovingCloth> cloths, int around,
                                                  bool all) {
  const auto take = [&](std::size_t cloth, int row, int col) {
    const PipelineCloth& one = cloths_[cloth];
    const int sample = one.grid.point(row * one.properties.size + col);
    put_end(cloths[cloth], one.first_point + sample, one.safe_position->at(sample));
    fates_[one.first_point + sample] = fallen_point;
  };
  for (std::size_t i = 0; all && i < cloths.size(); ++i)
    for (int r = 0; r < cloths_[i].properties.size; ++r)
      for (int c = 0; c < cloths_[i].properties.size; ++c) take(i, r, c);
  if (all) return;
  for (const int point : plane_filter_.stopped()) {
    const std::size_t cloth = cloth_of_[point];
    const int n = cloths_[cloth].properties.size, sample = point - cloths_[cloth].first_point;
    const int row = sample / n, col = sample % n;
    for (int r = std::max(0, row - around); r <= std::min(n - 1, row + around); ++r)
      for (int c = std::max(0, col - around); c <= std::min(n - 1, col + around); ++c)
        take(cloth, r, c);
  }
}

ImpactSides ContactPipeline::sides_of(const SeparatingPlane& plane,
                                      std::span<const MovingCloth> cloths) const {
  ImpactSides sides;
  sides.count_a = plane.count_a;
  sides.count_b = plane.count_b;
  for (int k = 0; k < plane.count_a + plane.count_b; ++k) {
    const std::size_t cloth = cloth_of_[plane.points[k]];
    const int n = cloths_[cloth].properties.size,
              sample = plane.points[k] - cloths_[cloth].first_point;
    sides.points[k] = {dot(plane.turned, vec_cast<double>(cloths[cloth].velocity.at(sample))),
                       cloths[cloth].inverse_mass(sample / n, sample % n)};
  }
  return sides;
}

void ContactPipeline::put_velocities(const SeparatingPlane& plane, const ImpactSides& sides,
                                     std::span<const MovingCloth> cloths) const {
  for (int k = 0; k < plane.count_a + plane.count_b; ++k) {
    const std::size_t cloth = cloth_of_[plane.points[k]];
    const int sample = plane.points[k] - cloths_[cloth].first_point;
    const Vec3d was = vec_cast<double>(cloths[cloth].velocity.at(sample));
    const double gained = sides.points[k].speed - dot(plane.turned, was);
    if (gained != 0)
      cloths[cloth].velocity.set(sample, vec_cast<float>(was + gained * plane.turned));
  }
}

/// One after the other in the planes' order, which is the same for any team.
void ContactPipeline::strike_all(std::span<const MovingCloth> cloths, double time_step) {
  for (const int p : plane_filter_.struck()) {
    ImpactSides sides = sides_of(planes_[p], cloths);
    sides.body_speed = planes_[p].body_displacement / time_step;
    strike(sides);
    put_velocities(planes_[p], sides, cloths);
  }
}

FilterCounts ContactPipeline::count_fates() const {
  FilterCounts counts;
  for (const char fate : fates_) {
    if (fate >= moved_point) ++counts.moved;
    if (fate >= stopped_point) ++counts.stopped;
    if (fate == fallen_point) ++counts.fell_back;
  }
  for (const PipelineCloth& one : cloths_) {
    bool whole = true;
    for (int s = 0; s < one.properties.size * one.properties.size && whole; ++s)
      whole = one.grid.point(s) != s || fates_[one.first_point + s] == fallen_point;
    counts.whole += whole ? 1 : 0;
  }
  return counts;
}

double ContactPipeline::fastest_body(double time_step) const {
  double fastest = 0;
  for (const PipelineBody& body : bodies_) fastest = std::max(fastest, body.max_moved / time_step);
  return fastest;
}

void ContactPipeline::carry_safe_positions(std::span<const MovingCloth> cloths, double spread,
                                           ThreadTeam& team) {
  carried_ = true;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    PipelineCloth& one = cloths_[i];
    const double spacing = one.properties.rest_spacing;
    if (one.carried.size() == 0) one.carried = Planes3(one.properties.size);
    SafePositionSurroundings around;
    around.bodies = contact_bodies_;
    around.ground = ground_ ? &*ground_ : nullptr;
    around.reached = spread * spacing;
    around.carried = carried_in_spreads * around.reached;
    around.slides = spread <= max_sliding_spread;
    around.held = held_in_spacings * spacing;
    safe_positions_.find(cloths[i].start, around, one.carried, team);
    one.safe_position = &one.carried;
  }
}

int ContactPipeline::filter_guess(std::span<const MovingCloth> cloths, double time_step,
                                  ThreadTeam& team) noexcept {
  return hold_all(cloths, time_step, Pass::guess, team).moved;
}

FilterCounts ContactPipeline::filter(std::span<const MovingCloth> cloths, double time_step,
                                     ThreadTeam& team) noexcept {
  if (untangler_.crossings() > 0) {
    untangler_.move(cloths, time_step);
    for (std::size_t i = 0; i < cloths_.size(); ++i) copy_to_mates(cloths_[i], cloths[i]);
  }
  return hold_all(cloths, time_step, Pass::end, team);
}

FilterCounts ContactPipeline::hold_all(std::span<const MovingCloth> cloths, double time_step,
                                       Pass pass, ThreadTeam& team) {
  gather_surfaces(cloths);
  for (std::size_t i = 0; i < cloths.size(); ++i) cloths_[i].safe_position = &cloths[i].start;
  carried_ = false;
  fates_.assign(static_cast<std::size_t>(points_), free_point);
  // What was held back in a frame will be again.
  bool& may_pass = may_pass_[static_cast<std::size_t>(pass)];
  may_pass = may_pass && all_pass(cloths, team);
  if (may_pass) {
    for (std::size_t i = 0; i < cloths_.size(); ++i) copy_to_mates(cloths_[i], cloths[i]);
    return {};
  }
  bool safe_positions_are_new = true;
  const bool moving = fastest_body(time_step) > 0;
  double spread = min_spread;
  for (int round = 0; round < max_rounds; ++round) {
    if (needs_boxes()) pairs_->refit(surfaces_, team);
    find_planes(std::exchange(safe_positions_are_new, false), team);
    add_ground_planes(cloths);
    new_points_.assign(static_cast<std::size_t>(points_), 0);
    const SeparatingPlaneFilter::Result held =
        hold(cloths, round < rounds_aside ? max_aside_ : slack_, team);
    if (pass == Pass::end) {
      strike_all(cloths, time_step);
      for (const int point : plane_filter_.lost()) {
        PipelineCloth& one = cloths_[cloth_of_[point]];
        one.body_contacts->doubt(point - one.first_point);
      }
    }
    safe_positions_are_new = held.lost > 0 && moving;
    if (safe_positions_are_new)
      carry_safe_positions(cloths, spread = std::min(2 * spread, max_spread), team);
    const bool settled = held.stopped + held.far == 0 && (held.lost == 0 || !moving);
    if (!settled && round >= rounds_on_the_way)
      fall_back_to_safe_positions(cloths, 1 << (round - rounds_on_the_way),
                                  round + 1 == max_rounds);
    for (std::size_t i = 0; i < cloths_.size(); ++i) copy_to_mates(cloths_[i], cloths[i]);
    if (settled) break;
  }
  return count_fates();
}

}  // namespace weft
