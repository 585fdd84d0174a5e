#include "weft/collide/filter/step_filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft {
namespace {

/// Points that were stopped or moved far may now meet others, so planes are searched again. The
/// first rounds allow long projections, which leave points their motion along what they meet; the
/// next ones stop points on their paths.
constexpr int rounds_aside = 4, rounds_on_the_way = 6;
/// Number of rounds in all. After the rounds above stopped points fall back together with a square
/// of samples around them, which doubles from round to round; in the last round whole cloths do.
constexpr int max_rounds = 14;
/// Safe positions follow bodies that moved onto points. The spread of that motion, in rest
/// spacings, doubles from round to round, starting with twice min_spread; within carried_in_spreads
/// of it points follow fully.
constexpr double min_spread = 4, max_spread = 64, carried_in_spreads = 0.25;
/// Up to this spread points follow bodies along normals only and may slide along them.
constexpr double max_sliding_spread = 16;
/// Range in which resting obstacles reduce the shift of safe positions.
constexpr double held_in_spacings = 4;
/// Paths that stay farther apart than this part of the slack do not cross, even by rounding.
constexpr double touching = 0.01;
/// Margin above the ground against rounding [m].
constexpr double ground_margin = 2e-6;

enum Fate : char { free_point, moved_point, stopped_point, fallen_point };

}  // namespace

StepFilter::StepFilter(CollisionWorld& world, const Untangler& untangler)
    : world_(world), untangler_(untangler), cloths_(world.cloths.size()) {}

PlaneSide StepFilter::side_of(std::size_t surface) const {
  const bool body = surface >= cloths_.size();
  return {world_.surfaces[surface],
          &world_.pairs().tiles(static_cast<int>(surface)),
          body ? 0 : world_.cloths[surface].first_point,
          body,
          body ? world_.surfaces[surface].end : cloths_[surface].safe_position,
          body ? nullptr : cloths_[surface].new_cells.data()};
}

void StepFilter::put_end(const MovingCloth& cloth, int point, Vec3f end) {
  const int sample = point - world_.cloths[world_.cloth_of(point)].first_point;
  if (cloth.position.at(sample) == end) return;
  cloth.position.set(sample, end);
  new_points_[point] = 1;
}

void StepFilter::drop_old_planes() {
  planes_.resize(ground_planes_);
  std::erase_if(planes_, [&](const SeparatingPlane& plane) {
    const auto first = plane.points.begin();
    return std::any_of(first, first + plane.count_a + plane.count_b,
                       [&](int point) { return new_points_[point] != 0; });
  });
}

void StepFilter::mark_new_cells() {
  for (std::size_t i = 0; i < cloths_.size(); ++i) {
    const WorldCloth& one = world_.cloths[i];
    std::vector<char>& new_cells = cloths_[i].new_cells;
    const int n = one.properties.size, cells = n - 1;
    new_cells.assign(static_cast<std::size_t>(cells) * cells, 0);
    for (int s = 0; s < n * n; ++s) {
      if (new_points_[one.first_point + one.grid.point(s)] == 0) continue;
      for (int r = std::max(0, s / n - 1); r <= std::min(cells - 1, s / n); ++r)
        for (int c = std::max(0, s % n - 1); c <= std::min(cells - 1, s % n); ++c)
          new_cells[static_cast<std::size_t>(r) * cells + c] = 1;
    }
  }
}

void StepFilter::find_planes(bool all, ThreadTeam& team) {
  if (all) {
    planes_.clear();
  } else {
    drop_old_planes();
    mark_new_cells();
  }
  add_planes(all, 2 * world_.slack(), team);
}

void StepFilter::add_planes(bool all, double farthest, ThreadTeam& team) {
  const float reach = static_cast<float>(farthest), slack = static_cast<float>(world_.slack());
  for (std::size_t i = 0; i < cloths_.size(); ++i)
    for (std::size_t j = i; j < world_.surfaces.size(); ++j) {
      if (i == j && !world_.cloths[i].properties.self_collision) continue;
      const int first = static_cast<int>(i), second = static_cast<int>(j);
      const std::span<const CandidateTile> cells =
          i == j ? world_.pairs().find_self(first, reach, slack, team)
                 : world_.pairs().find(first, second, reach, team);
      PlaneSearch search{side_of(i), side_of(j), i == j, {world_.slack(), carried_}};
      if (!all) search.new_points = new_points_.data();
      if (!search.b.body) search.tangle = untangler_.marks(i, j);
      if (search.b.body) {
        search.inside = &world_.cloths[i].body_contacts->inside();
        search.body_number = static_cast<int>(j - cloths_.size()) + 1;
        search.crossings = &world_.cloths[i].crossings[j - cloths_.size()];
        search.buried = world_.bodies[j - cloths_.size()].buried;
      }
      cell_planes_.find(search, cells, team, planes_);
    }
}

void StepFilter::add_ground_planes(std::span<const MovingCloth> moving) {
  ground_planes_ = planes_.size();
  if (world_.ground() == nullptr) return;
  const double min = world_.ground()->height + ground_margin;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const WorldCloth& one = world_.cloths[i];
    for (int s = 0; s < one.properties.size * one.properties.size; ++s) {
      if (one.grid.point(s) != s || moving[i].position.at(s).y >= min + world_.slack() ||
          moving[i].start.at(s).y < min)
        continue;
      SeparatingPlane plane;
      plane.normal = plane.turned = {0, 1, 0};
      plane.at_end.a = plane.still.a = min;
      plane.points[0] = one.first_point + s;
      plane.count_a = 1;
      planes_.push_back(plane);
    }
  }
}

FilteredPoint StepFilter::point_at(std::span<const MovingCloth> moving, int point) const {
  const std::size_t cloth = world_.cloth_of(point);
  const int sample = point - world_.cloths[cloth].first_point;
  const int n = world_.cloths[cloth].properties.size;
  FilteredPoint at{moving[cloth].start.at(sample), cloths_[cloth].safe_position->at(sample),
                   moving[cloth].position.at(sample)};
  // Pins that move are put aside as other points are: stopped, they would hold back all around.
  at.stays = moving[cloth].inverse_mass(sample / n, sample % n) == 0 && at.start == at.end;
  return at;
}

/// Whether all proposed ends may stay. Only features whose paths nearly touch need planes for this,
/// as long as no plane moves a point.
bool StepFilter::all_pass(std::span<const MovingCloth> moving, ThreadTeam& team) {
  world_.refit(team);
  planes_.clear();
  add_planes(true, touching * world_.slack(), team);
  add_ground_planes(moving);
  return plane_filter_.all_satisfied(
      planes_, world_.points(), [&](int point) { return point_at(moving, point); }, team);
}

SeparatingPlaneFilter::Result StepFilter::find_ends(std::span<const MovingCloth> moving,
                                                    double farthest, ThreadTeam& team) {
  add_ground_planes(moving);
  return plane_filter_.find_ends(
      planes_, world_.points(), {world_.slack(), farthest},
      [&](int point) { return point_at(moving, point); }, team);
}

SeparatingPlaneFilter::Result StepFilter::find_ends_anew(std::span<const MovingCloth> moving,
                                                         double farthest, ThreadTeam& team) {
  find_planes(true, team);
  return find_ends(moving, farthest, team);
}

SeparatingPlaneFilter::Result StepFilter::hold(std::span<const MovingCloth> moving, double farthest,
                                               ThreadTeam& team) {
  SeparatingPlaneFilter::Result found = find_ends(moving, farthest, team);
  if (found.stopped + found.lost > 0 && std::exchange(may_go_along_, false) &&
      take_safe_positions_along(moving, team))
    found = find_ends_anew(moving, farthest, team);
  if (found.lost > 0 && along_) {
    return_safe_positions(moving);
    found = find_ends_anew(moving, farthest, team);
  }
  new_points_.assign(static_cast<std::size_t>(world_.points()), 0);
  plane_filter_.put_ends([&](int point, Vec3f end) {
    put_end(moving[world_.cloth_of(point)], point, end);
    fates_[point] = std::max<char>(fates_[point], moved_point);
  });
  for (const int point : plane_filter_.stopped())
    fates_[point] = std::max<char>(fates_[point], stopped_point);
  return found;
}

void StepFilter::fall_back_to_safe_positions(std::span<const MovingCloth> moving, int around,
                                             bool all) {
  const auto put_back = [&](std::size_t cloth, int row, int col) {
    const WorldCloth& one = world_.cloths[cloth];
    const int sample = one.grid.point(row * one.properties.size + col);
    put_end(moving[cloth], one.first_point + sample, cloths_[cloth].safe_position->at(sample));
    fates_[one.first_point + sample] = fallen_point;
  };
  for (std::size_t i = 0; all && i < moving.size(); ++i)
    for (int r = 0; r < world_.cloths[i].properties.size; ++r)
      for (int c = 0; c < world_.cloths[i].properties.size; ++c) put_back(i, r, c);
  if (all) return;
  for (const int point : plane_filter_.stopped()) {
    const std::size_t cloth = world_.cloth_of(point);
    const int n = world_.cloths[cloth].properties.size,
              sample = point - world_.cloths[cloth].first_point;
    const int row = sample / n, col = sample % n;
    for (int r = std::max(0, row - around); r <= std::min(n - 1, row + around); ++r)
      for (int c = std::max(0, col - around); c <= std::min(n - 1, col + around); ++c)
        put_back(cloth, r, c);
  }
}

ImpactSides StepFilter::sides_of(const SeparatingPlane& plane,
                                 std::span<const MovingCloth> moving) const {
  ImpactSides sides;
  sides.count_a = plane.count_a;
  sides.count_b = plane.count_b;
  for (int k = 0; k < plane.count_a + plane.count_b; ++k) {
    const std::size_t cloth = world_.cloth_of(plane.points[k]);
    const int n = world_.cloths[cloth].properties.size,
              sample = plane.points[k] - world_.cloths[cloth].first_point;
    sides.points[k] = {dot(plane.turned, vec_cast<double>(moving[cloth].velocity.at(sample))),
                       moving[cloth].inverse_mass(sample / n, sample % n)};
  }
  return sides;
}

void StepFilter::put_velocities(const SeparatingPlane& plane, const ImpactSides& sides,
                                std::span<const MovingCloth> moving) const {
  for (int k = 0; k < plane.count_a + plane.count_b; ++k) {
    const std::size_t cloth = world_.cloth_of(plane.points[k]);
    const int sample = plane.points[k] - world_.cloths[cloth].first_point;
    const Vec3d was = vec_cast<double>(moving[cloth].velocity.at(sample));
    const double gained = sides.points[k].speed - dot(plane.turned, was);
    if (gained != 0)
      moving[cloth].velocity.set(sample, vec_cast<float>(was + gained * plane.turned));
  }
}

/// Impacts are applied one after another in the planes' order, which is the same for any team.
void StepFilter::strike_all(std::span<const MovingCloth> moving, double time_step) {
  for (const int p : plane_filter_.struck()) {
    struck_.push_back(planes_[p]);
    ImpactSides sides = sides_of(planes_[p], moving);
    sides.body_speed = planes_[p].body_displacement / time_step;
    strike(sides);
    put_velocities(planes_[p], sides, moving);
  }
}

bool StepFilter::has_fallen() const {
  return std::find(fates_.begin(), fates_.end(), fallen_point) != fates_.end();
}

FilterCounts StepFilter::count_fates() const {
  FilterCounts counts;
  for (const char fate : fates_) {
    if (fate >= moved_point) ++counts.moved;
    if (fate >= stopped_point) ++counts.stopped;
    if (fate == fallen_point) ++counts.fell_back;
  }
  for (const WorldCloth& one : world_.cloths) {
    bool whole = true;
    for (int s = 0; s < one.properties.size * one.properties.size && whole; ++s)
      whole = one.grid.point(s) != s || fates_[one.first_point + s] == fallen_point;
    counts.whole += whole ? 1 : 0;
  }
  return counts;
}

void StepFilter::carry_safe_positions(std::span<const MovingCloth> moving, double spread,
                                      ThreadTeam& team) {
  carried_ = true;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    Filtered& one = cloths_[i];
    const CollidingCloth& properties = world_.cloths[i].properties;
    const double spacing = properties.rest_spacing;
    if (one.carried.size() == 0) one.carried = Planes3(properties.size);
    SafePositionSurroundings around;
    around.bodies = world_.contact_bodies;
    around.ground = world_.ground();
    around.reached = spread * spacing;
    around.carried = carried_in_spreads * around.reached;
    around.slides = spread <= max_sliding_spread;
    around.held = held_in_spacings * spacing;
    safe_positions_.find(moving[i].start, around, one.carried, team);
    one.safe_position = &one.carried;
  }
}

bool StepFilter::take_safe_positions_along(std::span<const MovingCloth> moving, ThreadTeam& team) {
  common_motion_.clear();
  for (std::size_t i = 0; i < moving.size(); ++i)
    common_motion_.add(moving[i], world_.cloths[i].grid);
  common_motion_.find(1 / SafePositions::max_part_of_distance);
  if (!common_motion_.any()) return false;
  SafePositionSurroundings obstacles{world_.contact_bodies, world_.ground()};
  for (std::size_t i = 0; i < moving.size(); ++i) {
    Filtered& one = cloths_[i];
    if (one.carried.size() == 0) one.carried = Planes3(world_.cloths[i].properties.size);
    SafePositions::find_along(moving[i].start, obstacles, common_motion_.of(i), one.carried, team);
    one.safe_position = &one.carried;
  }
  return along_ = true;
}

void StepFilter::return_safe_positions(std::span<const MovingCloth> moving) {
  for (std::size_t i = 0; i < moving.size(); ++i) cloths_[i].safe_position = &moving[i].start;
  along_ = false;
}

void StepFilter::begin(std::span<const MovingCloth> moving) {
  world_.gather_surfaces(moving);
  return_safe_positions(moving);
  carried_ = false;
  all_anew_ = true;
  struck_.clear();
  spread_ = min_spread;
  fates_.assign(static_cast<std::size_t>(world_.points()), free_point);
}

FilterCounts StepFilter::run(std::span<const MovingCloth> moving, double time_step, Pass pass,
                             ThreadTeam& team, FilterEnd end) {
  begin(moving);
  may_go_along_ = world_.fastest_body(time_step) == 0;
  // Once the quick test fails in a frame it is skipped: points will be held back again.
  bool& may_pass = may_pass_[static_cast<std::size_t>(pass)];
  may_pass = may_pass && all_pass(moving, team);
  if (may_pass) {
    world_.copy_to_mates(moving);
    return {};
  }
  for (int round = 0; round < max_rounds; ++round) {
    if (do_round(moving, time_step, pass, round, team)) break;
    if (end == FilterEnd::unless_falls && has_fallen()) break;
  }
  return count_fates();
}

bool StepFilter::do_round(std::span<const MovingCloth> moving, double time_step, Pass pass,
                          int round, ThreadTeam& team) {
  const bool bodies_move = world_.fastest_body(time_step) > 0;
  world_.refit(team);
  find_planes(std::exchange(all_anew_, false), team);
  const SeparatingPlaneFilter::Result held =
      hold(moving, round < rounds_aside ? world_.max_aside() : world_.slack(), team);
  if (pass == Pass::end) {
    strike_all(moving, time_step);
    for (const int point : plane_filter_.lost()) {
      WorldCloth& cloth = world_.cloths[world_.cloth_of(point)];
      cloth.body_contacts->doubt(point - cloth.first_point);
      for (BodyCrossings& crossings : cloth.crossings) crossings.recheck();
    }
  }
  // Where safe positions that follow bodies as far as ever do not help, sides of a body close on
  // the cloth: what is lost there stays so, and takes nothing else back with it.
  const bool caught = spread_ >= max_spread;
  all_anew_ = held.lost > 0 && bodies_move && !caught;
  if (all_anew_) carry_safe_positions(moving, spread_ = std::min(2 * spread_, max_spread), team);
  const bool settled = held.stopped + held.far == 0 && (held.lost == 0 || !bodies_move || caught);
  if (!settled && round >= rounds_on_the_way)
    fall_back_to_safe_positions(moving, 1 << (round - rounds_on_the_way), round + 1 == max_rounds);
  world_.copy_to_mates(moving);
  return settled;
}

}  // namespace weft
