#include "weft/collide/collision_world.h"

#include <algorithm>
#include <utility>

namespace weft {
namespace {

/// Slack of the filter in gaps between cloths and in rest spacings; the smaller one counts.
constexpr double slack_in_gaps = 0.2, slack_in_spacings = 0.03;
constexpr double aside_in_spacings = 1;
/// Skin of cached pairs, in gaps kept to bodies: surfaces may move by half of it before pairs are
/// searched anew.
constexpr double skin_in_gaps = 0.5;
/// Bodies that move farther than this in a step, in gaps kept to them, approach along normals.
constexpr double slides_in_gaps = 0.75;

}  // namespace

CollisionWorld::CollisionWorld(MakeBroadPhase make_broad_phase, const Obstacles& obstacles,
                               std::span<const CollidingCloth> given) {
  cloths.reserve(given.size());
  for (const CollidingCloth& cloth : given) {
    cloths.push_back(
        {SurfaceGrid(cloth.size, cloth.mates, cloth.diagonals, cloth.sewn), cloth, points(), {}});
    cloth_of_.insert(cloth_of_.end(), static_cast<std::size_t>(cloth.size) * cloth.size,
                     cloths.size() - 1);
    slack_ = std::min(
        {slack_, slack_in_gaps * cloth.self_thickness, slack_in_spacings * cloth.rest_spacing});
    max_aside_ = std::min(max_aside_, aside_in_spacings * cloth.rest_spacing);
    min_gap_ = std::min(min_gap_, cloth.thickness);
  }
  for (WorldCloth& cloth : cloths)
    cloth.body_contacts = std::make_unique<BodyContacts>(cloth.grid, cloth.properties);
  bodies.reserve(obstacles.bodies.size());
  for (const Body& body : obstacles.bodies)
    bodies.push_back({SurfaceGrid(body.positions.size(), body.mates, body.diagonals), nullptr,
                      nullptr, body.positions, nullptr, body.friction});
  for (WorldBody& body : bodies) {
    body.query = std::make_unique<BodyQuery>(body.grid);
    body.end = &body.start;
    body.buried.reserve(2 * static_cast<std::size_t>(body.grid.cells()) * body.grid.cells());
  }
  if (obstacles.ground) ground_ = {*obstacles.ground, obstacles.ground_friction};
  std::vector<const SurfaceGrid*> grids;
  for (const WorldCloth& cloth : cloths) grids.push_back(&cloth.grid);
  for (const WorldBody& body : bodies) grids.push_back(&body.grid);
  const auto skin = static_cast<float>(skin_in_gaps * min_gap_);
  pairs_.emplace(make_broad_phase(grids, cloths.size()), grids, cloths.size(), skin);
  for (WorldCloth& cloth : cloths) cloth.crossings.resize(bodies.size());
}

bool CollisionWorld::needs_boxes() const {
  const bool lonely = bodies.empty() && cloths.size() == 1;
  return !lonely || cloths.front().properties.self_collision;
}

void CollisionWorld::stand_still(WorldBody& body) {
  body.end = &body.start;
  body.max_moved = 0;
  body.goes_far = false;
}

void CollisionWorld::move_bodies(std::span<const Planes3* const> ends, ThreadTeam& team) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    WorldBody& body = bodies[i];
    stand_still(body);
    const double max_moved = ends[i] != nullptr ? largest_displacement(body.start, *ends[i]) : 0;
    if (max_moved == 0) continue;
    body.end = ends[i];
    body.max_moved = max_moved;
    body.goes_far = max_moved > slides_in_gaps * min_gap_;
    ++body.motion;
    measure_motion(body, team);
  }
}

/// Bodies that go far mostly slide along themselves, so their approach is measured along surface
/// normals and not by the displacements of points.
void CollisionWorld::measure_motion(WorldBody& body, ThreadTeam& team) const {
  if (body.goes_far && !body.surface) body.surface = std::make_unique<SurfaceMotion>(body.grid);
  if (body.goes_far) body.surface->measure(body.start, *body.end, team);
  body.blocks.measure(body.grid, body.start, *body.end,
                      body.goes_far ? body.surface.get() : nullptr, team);
}

void CollisionWorld::commit() {
  for (WorldCloth& cloth : cloths) cloth.body_contacts->commit();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    WorldBody& body = bodies[i];
    if (!body.moves()) continue;
    for (WorldCloth& cloth : cloths) cloth.body_contacts->arrive(i, body.motion);
    body.start = *body.end;
    if (body.goes_far)
      body.surface->arrive();
    else if (body.surface)
      body.surface->forget();
    body.moved = !take_query_over(body);
    ++body.placement;
    ++body.motion;
    stand_still(body);
  }
}

/// What was fitted to a body's end is fitted to where it starts next.
bool CollisionWorld::take_query_over(WorldBody& body) {
  if (!body.goes_far || body.end_placed != body.motion) return false;
  std::swap(body.query, body.query_at_end);
  body.query->follow(body.start);
  return true;
}

void CollisionWorld::rollback() {
  for (WorldCloth& cloth : cloths) cloth.body_contacts->rollback();
  for (WorldBody& body : bodies) {
    if (!body.moves()) continue;
    ++body.motion;
    stand_still(body);
  }
}

void CollisionWorld::bury(std::size_t index, std::span<const char> samples) {
  WorldBody& body = bodies[index];
  const int cells = body.grid.cells();
  body.buried.assign(samples.empty() ? 0 : 2 * static_cast<std::size_t>(cells) * cells, 0);
  for (std::size_t t = 0; t < body.buried.size(); ++t) {
    const std::array<int, 3> corners =
        body.grid.triangle(static_cast<int>(t) / 2, static_cast<int>(t) % 2);
    const auto [least, most] =
        std::minmax({samples[corners[0]], samples[corners[1]], samples[corners[2]]});
    body.buried[t] = least > 1 ? 2 : most > 0 ? 1 : 0;
  }
}

void CollisionWorld::gather_surfaces(std::span<const MovingCloth> moving) {
  surfaces.clear();
  for (std::size_t i = 0; i < moving.size(); ++i)
    surfaces.push_back({&cloths[i].grid, &moving[i].start, &moving[i].position});
  for (const WorldBody& body : bodies)
    surfaces.push_back({&body.grid, &body.start, body.end, body.motion});
}

void CollisionWorld::refit(ThreadTeam& team) {
  if (needs_boxes()) pairs_->refit(surfaces, team);
}

void CollisionWorld::place_bodies(ThreadTeam& team) {
  contact_bodies.clear();
  for (WorldBody& body : bodies) {
    if (body.moved) body.query->place(body.start, team);
    body.moved = false;
    if (body.goes_far && !body.query_at_end)
      body.query_at_end = std::make_unique<BodyQuery>(body.grid);
    if (body.goes_far && body.end_placed != body.motion) {
      body.query_at_end->place(*body.end, team);
      body.end_placed = body.motion;
    }
    contact_bodies.push_back(
        {static_cast<int>(contact_bodies.size()) + 1, body.query.get(), &body.start, body.end,
         body.friction, body.goes_far ? body.query_at_end.get() : nullptr,
         body.moves() ? body.blocks.max_approach() : 0, body.moves() ? &body.blocks : nullptr,
         body.motion, body.placement, body.buried});
  }
}

void CollisionWorld::copy_to_mates(std::span<const MovingCloth> moving) const {
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    const BorderMates& mates = cloths[i].properties.mates;
    for (int k = 0; k < mates.class_count(); ++k)
      for (const int s : mates.mates(k).subspan(1)) {
        moving[i].position.set(s, moving[i].position.at(mates.mates(k)[0]));
        moving[i].velocity.set(s, moving[i].velocity.at(mates.mates(k)[0]));
      }
  }
}

double CollisionWorld::gap_between(std::size_t i, std::size_t j) const {
  return 0.5 * (cloths[i].properties.self_thickness + cloths[j].properties.self_thickness);
}

std::span<const CandidateTile> CollisionWorld::near_cells(std::size_t i, std::size_t j,
                                                          ThreadTeam& team) {
  const int first = static_cast<int>(i), second = static_cast<int>(j);
  const auto reach = static_cast<float>(contact_margin * gap_between(i, j));
  if (i == j) return pairs_->find_self(first, reach, static_cast<float>(slack_), team);
  return pairs_->find(first, second, reach, team);
}

void CollisionWorld::find_crossings(std::span<const MovingCloth> moving, ThreadTeam& team) {
  for (std::size_t i = 0; i < cloths.size(); ++i)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      BodyCrossings& crossings = cloths[i].crossings[b];
      const ContactBody& body = contact_bodies[b];
      if (!body.query->closed() || (!crossings.is_open() && body.buried.empty() &&
                                    !cloths[i].body_contacts->any_inside(body.number)))
        continue;
      const std::span<const CandidateTile> cells =
          pairs_->find(static_cast<int>(i), static_cast<int>(cloths.size() + b), 0, team);
      crossings.find({cloths[i].grid, moving[i].start, bodies[b].grid, body}, cells, team);
    }
}

double CollisionWorld::fastest_body(double time_step) const {
  double fastest = 0;
  for (const WorldBody& body : bodies) fastest = std::max(fastest, body.max_moved / time_step);
  return fastest;
}

}  // namespace weft
