#include "weft/collide/contact_pipeline.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// How far the filter may move a point aside before the rest has to be looked at again: parts of
/// the gap that is kept, and of the rest spacing.
constexpr double slack_in_gaps = 0.2, slack_in_spacings = 0.03;
/// And in the first rounds, after which it is.
constexpr double aside_in_spacings = 1;
/// Twice what cloth may move before pairs that came near are looked for anew.
constexpr double skin_in_gaps = 0.5;
/// Finer cloth bends round its thickness over several cells.
constexpr double min_crease_in_gaps = 3;

std::vector<Triangle> triangles_by_points(const SurfaceGrid& grid) {
  std::vector<Triangle> triangles;
  for (int t = 0; t < 2 * grid.cells() * grid.cells(); ++t) {
    const std::array<int, 3> samples = grid.triangle(t / 2, t % 2);
    if (!grid.folded(samples))
      triangles.push_back({grid.point(samples[0]), grid.point(samples[1]), grid.point(samples[2])});
  }
  return triangles;
}

}  // namespace

ContactPipeline::ContactPipeline(MakeBroadPhase make_broad_phase, const Obstacles& obstacles,
                                 std::span<const CollidingCloth> cloths) {
  slack_ = max_aside_ = HUGE_VAL;
  cloths_.reserve(cloths.size());
  for (const CollidingCloth& cloth : cloths) {
    cloths_.push_back({SurfaceGrid(cloth.size, cloth.mates, cloth.diagonals),
                       cloth,
                       nullptr,
                       nullptr,
                       ContactResponse(cloth.mates),
                       {},
                       points_,
                       {}});
    points_ += cloth.size * cloth.size;
    slack_ = std::min(
        {slack_, slack_in_gaps * cloth.self_thickness, slack_in_spacings * cloth.rest_spacing});
  }
  min_gap_ = HUGE_VAL;
  for (const CollidingCloth& cloth : cloths) min_gap_ = std::min(min_gap_, cloth.thickness);
  for (const CollidingCloth& cloth : cloths)
    max_aside_ = std::min(max_aside_, aside_in_spacings * cloth.rest_spacing);
  for (PipelineCloth& one : cloths_) {
    one.body_contacts = std::make_unique<BodyContacts>(one.grid, one.properties);
    one.corner_contacts = std::make_unique<CornerContacts>(one.grid, one.properties);
  }
  bodies_.reserve(obstacles.bodies.size());
  for (const Body& body : obstacles.bodies) {
    bodies_.push_back({SurfaceGrid(body.positions.size(), body.mates, body.diagonals), nullptr,
                       nullptr, body.positions, nullptr, body.friction});
  }
  for (PipelineBody& body : bodies_) {
    body.query = std::make_unique<BodyQuery>(body.grid);
    body.end = &body.start;
    body.triangles = triangles_by_points(body.grid);
  }
  learn_corners(obstacles);
  if (obstacles.ground) ground_ = {*obstacles.ground, obstacles.ground_friction};
  std::vector<const SurfaceGrid*> grids;
  for (const PipelineCloth& one : cloths_) grids.push_back(&one.grid);
  for (const PipelineBody& body : bodies_) grids.push_back(&body.grid);
  const auto skin = static_cast<float>(skin_in_gaps * min_gap_);
  pairs_.emplace(make_broad_phase(grids, cloths_.size()), grids, cloths_.size(), skin);
  untangler_.set_up(std::span(grids).first(cloths_.size()), cloths);
  for (std::size_t i = 0; i < cloths_.size(); ++i)
    cloth_of_.insert(
        cloth_of_.end(),
        static_cast<std::size_t>(cloths_[i].properties.size) * cloths_[i].properties.size, i);
}

void ContactPipeline::learn_corners(const Obstacles& obstacles) {
  ThreadTeam alone(1);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Planes3& given = obstacles.bodies[i].shape;
    const Planes3& shape = given.size() > 0 ? given : obstacles.bodies[i].positions;
    bodies_[i].query->place(shape, alone);
    for (PipelineCloth& one : cloths_)
      one.corner_contacts->add_body(bodies_[i].grid, *bodies_[i].query, shape);
  }
}

bool ContactPipeline::needs_boxes() const {
  const bool lonely = bodies_.empty() && cloths_.size() == 1;
  return !lonely || cloths_.front().properties.self_collision;
}

void ContactPipeline::move_bodies(std::span<const Planes3* const> ends, ThreadTeam& team) noexcept {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    PipelineBody& body = bodies_[i];
    body.end = ends[i] != nullptr ? ends[i] : &body.start;
    body.max_moved = body.max_approach = 0;
    body.goes_far = false;
    if (body.end == &body.start) continue;
    body.max_moved = largest_displacement(body.start, *body.end);
    if (body.max_moved == 0) {
      body.end = &body.start;
      continue;
    }
    ++body.motion;
    measure_motion(body, team);
  }
}

/// What goes far in a step mostly slides past: its surface, not each of its points, is followed.
void ContactPipeline::measure_motion(PipelineBody& body, ThreadTeam& team) const {
  body.max_approach = body.max_moved;
  body.goes_far = body.max_moved > min_gap_;
  if (body.goes_far) body.surface.measure(body.start, *body.end, body.triangles, team);
  body.blocks.measure(body.grid, body.start, *body.end, body.goes_far ? &body.surface : nullptr,
                      team);
  if (!body.goes_far) return;
  body.max_approach = 0;
  for (const Triangle& t : body.triangles)
    for (const int corner : t)
      body.max_approach = std::max(body.max_approach, body.surface.approach(corner));
}

void ContactPipeline::commit() noexcept {
  may_pass_then_ = may_pass_;
  for (PipelineCloth& one : cloths_) one.body_contacts->commit();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    PipelineBody& body = bodies_[i];
    if (body.end == &body.start) continue;
    for (PipelineCloth& one : cloths_) one.body_contacts->arrive(i, body.motion);
    body.start = *body.end;
    body.end = &body.start;
    body.max_moved = body.max_approach = 0;
    body.goes_far = false;
    body.moved = true;
    ++body.motion;
  }
}

void ContactPipeline::rollback() noexcept {
  may_pass_ = may_pass_then_;
  for (PipelineCloth& one : cloths_) one.body_contacts->rollback();
  for (PipelineBody& body : bodies_) {
    if (body.end == &body.start) continue;
    body.end = &body.start;
    body.max_moved = body.max_approach = 0;
    body.goes_far = false;
    ++body.motion;
  }
}

void ContactPipeline::gather_surfaces(std::span<const MovingCloth> cloths) {
  surfaces_.clear();
  for (std::size_t i = 0; i < cloths.size(); ++i)
    surfaces_.push_back({&cloths_[i].grid, &cloths[i].start, &cloths[i].position});
  for (const PipelineBody& body : bodies_)
    surfaces_.push_back({&body.grid, &body.start, body.end, body.motion});
}

void ContactPipeline::place_bodies(ThreadTeam& team) {
  contact_bodies_.clear();
  for (PipelineBody& body : bodies_) {
    if (body.moved) body.query->place(body.start, team);
    body.moved = false;
    if (body.goes_far && !body.query_at_end)
      body.query_at_end = std::make_unique<BodyQuery>(body.grid);
    if (body.goes_far && body.end_placed != body.motion) {
      body.query_at_end->place(*body.end, team);
      body.end_placed = body.motion;
    }
    contact_bodies_.push_back({static_cast<int>(contact_bodies_.size()) + 1, body.query.get(),
                               &body.start, body.end, body.friction,
                               body.goes_far ? body.query_at_end.get() : nullptr, body.max_approach,
                               body.end == &body.start ? nullptr : &body.blocks, body.motion});
  }
}

void ContactPipeline::detect(std::span<const MovingCloth> cloths, double time_step,
                             ThreadTeam& team) noexcept {
  place_bodies(team);
  gather_surfaces(cloths);
  if (needs_boxes()) pairs_->refit(surfaces_, team);
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    PipelineCloth& one = cloths_[i];
    one.body_contacts->find(cloths[i], contact_bodies_, ground_ ? &*ground_ : nullptr, team);
    one.corner_contacts->find({cloths[i], one.body_contacts->inside(),
                               pairs_->boxes(static_cast<int>(i)), pairs_->skin()},
                              contact_bodies_, team);
    one.contacts.clear();
    for (const std::span<const Contact> found :
         {one.body_contacts->contacts(), one.corner_contacts->contacts()})
      one.contacts.insert(one.contacts.end(), found.begin(), found.end());
    one.obstacle_contacts = one.contacts.size();
  }
  near_ = std::any_of(cloths_.begin(), cloths_.end(),
                      [](const PipelineCloth& one) { return one.obstacle_contacts > 0; });
  find_tangles(cloths, team);
  find_pair_contacts(cloths, time_step, team);
}

double ContactPipeline::gap_between(std::size_t i, std::size_t j) const {
  return 0.5 * (cloths_[i].properties.self_thickness + cloths_[j].properties.self_thickness);
}

std::span<const CandidatePair> ContactPipeline::near_cells(std::size_t i, std::size_t j,
                                                           ThreadTeam& team) {
  const int first = static_cast<int>(i), second = static_cast<int>(j);
  const auto reach = static_cast<float>(contact_margin * gap_between(i, j));
  if (i == j) return pairs_->find_self(first, reach, static_cast<float>(slack_), team);
  return pairs_->find(first, second, reach, team);
}

void ContactPipeline::find_tangles(std::span<const MovingCloth> cloths, ThreadTeam& team) {
  for (std::size_t i = 0; i < cloths.size(); ++i)
    for (std::size_t j = i; j < cloths.size(); ++j) {
      if (!untangler_.is_open(i, j) || (i == j && !cloths_[i].properties.self_collision)) continue;
      untangler_.find_crossings(i, j, cloths, near_cells(i, j, team), team);
    }
}

void ContactPipeline::find_pair_contacts(std::span<const MovingCloth> cloths, double time_step,
                                         ThreadTeam& team) {
  shared_.clear();
  const auto before = [&] {
    int count = static_cast<int>(shared_.size());
    for (const PipelineCloth& one : cloths_) count += static_cast<int>(one.contacts.size());
    return count;
  };
  const int with_bodies = before();
  for (std::size_t i = 0; i < cloths.size(); ++i)
    for (std::size_t j = i; j < cloths.size(); ++j) {
      PipelineCloth &a = cloths_[i], &b = cloths_[j];
      if (i == j && !a.properties.self_collision) continue;
      const int first = static_cast<int>(i), second = static_cast<int>(j);
      const std::span<const CandidatePair> cells = near_cells(i, j, team);
      near_ = near_ || !cells.empty();
      pair_contacts_.find(
          {&a.grid, &b.grid, &cloths[i], &cloths[j], first, second, a.properties.rest,
           gap_between(i, j), std::sqrt(a.properties.friction * b.properties.friction), time_step,
           i == j && a.properties.rest_spacing >= min_crease_in_gaps * gap_between(i, j),
           untangler_.marks(i, j)},
          cells, team, {a.contacts, b.contacts, shares_ ? &shared_ : nullptr});
    }
  self_contacts_ = before() - with_bodies;
}

void ContactPipeline::save_marks(std::size_t cloth, std::vector<int>& marks) const {
  cloths_[cloth].body_contacts->save(marks);
  for (std::size_t other = cloth; !marks.empty() && other < cloths_.size(); ++other)
    marks.push_back(untangler_.is_open(cloth, other) ? 1 : 0);
}

void ContactPipeline::restore_marks(std::size_t cloth, std::span<const int> marks) {
  const auto samples =
      static_cast<std::size_t>(cloths_[cloth].properties.size) * cloths_[cloth].properties.size;
  const std::size_t pairs = cloths_.size() - cloth;
  const bool known = marks.size() == samples + pairs;
  cloths_[cloth].body_contacts->restore(known ? marks.first(samples) : std::span<const int>());
  for (std::size_t k = 0; k < pairs; ++k)
    untangler_.set_open(cloth, cloth + k, !known || marks[samples + k] != 0);
}

int ContactPipeline::correct(std::size_t cloth, const MovingCloth& moving,
                             std::span<const float> forces, double time_step,
                             ThreadTeam& team) noexcept {
  PipelineCloth& one = cloths_[cloth];
  // Layers are soft and stay as they were solved.
  const std::span<const Contact> hard = std::span(one.contacts).first(one.obstacle_contacts);
  return one.response.respond(moving, {hard, forces.first(std::min(forces.size(), hard.size()))},
                              time_step, team);
}

void ContactPipeline::copy_to_mates(const PipelineCloth& one, const MovingCloth& moving) {
  const BorderMates& mates = one.properties.mates;
  for (int k = 0; k < mates.class_count(); ++k)
    for (const int s : mates.mates(k).subspan(1)) {
      moving.position.set(s, moving.position.at(mates.mates(k)[0]));
      moving.velocity.set(s, moving.velocity.at(mates.mates(k)[0]));
    }
}

double ContactPipeline::smallest_gap(std::size_t cloth, const Planes3& positions,
                                     ThreadTeam& team) noexcept {
  PipelineCloth& one = cloths_[cloth];
  place_bodies(team);
  const int n = positions.size();
  one.row_gaps.resize(static_cast<std::size_t>(n));
  const double reach = 2 * one.properties.thickness;
  team.run([&](Worker& worker) {
    const Range rows = worker.share(n);
    for (int r = rows.first; r < rows.last; ++r) {
      double least = HUGE_VAL;
      for (int c = 0; c < n; ++c) {
        const Vec3d p = vec_cast<double>(positions.at(r, c));
        if (ground_) least = std::min(least, p.y - ground_->height);
        for (const ContactBody& body : contact_bodies_)
          if (const auto found = body.query->closest(p, reach)) {
            const bool kept_in = one.properties.is_kept_in(body.number - 1);
            const bool astray = body.query->closed() && body.query->behind(p, *found) != kept_in;
            const double distance = std::sqrt(found->squared_distance);
            least = std::min(least, astray ? -distance : distance);
          }
      }
      one.row_gaps[r] = least;
    }
  });
  return *std::min_element(one.row_gaps.begin(), one.row_gaps.end());
}

}  // namespace weft
