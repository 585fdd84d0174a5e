#include "weft/collide/contact_pipeline.h"

#include <algorithm>
#include <cmath>

namespace weft {

ContactPipeline::ContactPipeline(CollisionWorld::MakeBroadPhase make_broad_phase,
                                 const Obstacles& obstacles, std::span<const CollidingCloth> cloths)
    : world_(make_broad_phase, obstacles, cloths),
      finder_(world_, obstacles),
      filter_(world_, untangler_),
      struck_(world_) {
  std::vector<const SurfaceGrid*> grids;
  for (const WorldCloth& cloth : world_.cloths) {
    grids.push_back(&cloth.grid);
    responses_.emplace_back(cloth.properties.mates);
  }
  untangler_.set_up(grids, cloths);
}

void ContactPipeline::detect(std::span<const MovingCloth> cloths, double time_step,
                             ThreadTeam& team) noexcept {
  world_.place_bodies(team);
  world_.gather_surfaces(cloths);
  world_.refit(team);
  world_.find_crossings(cloths, team);
  finder_.find_with_bodies(cloths, time_step, team);
  find_tangles(cloths, team);
  finder_.find_between_cloths(cloths, time_step, untangler_, team);
  finder_.add_struck(struck_.found(), time_step);
  finder_.take_ends(cloths);
}

/// What crosses at the start of the step does so still.
void ContactPipeline::detect_again(std::span<const MovingCloth> cloths, double time_step,
                                   ThreadTeam& team) noexcept {
  world_.gather_surfaces(cloths);
  world_.refit(team);
  finder_.find_with_bodies(cloths, time_step, team);
  finder_.find_where_moved(cloths, time_step, untangler_, team);
  finder_.add_struck(struck_.found(), time_step);
}

void ContactPipeline::find_tangles(std::span<const MovingCloth> cloths, ThreadTeam& team) {
  for (std::size_t i = 0; i < cloths.size(); ++i)
    for (std::size_t j = i; j < cloths.size(); ++j) {
      if (!untangler_.is_open(i, j) || (i == j && !world_.cloths[i].properties.self_collision))
        continue;
      untangler_.find_crossings(i, j, cloths, world_.near_cells(i, j, team), team);
    }
}

int ContactPipeline::filter_guess(std::span<const MovingCloth> cloths, double time_step,
                                  ThreadTeam& team) noexcept {
  const int moved = filter_.run(cloths, time_step, StepFilter::Pass::guess, team).moved;
  finder_.take_ends(cloths);
  return moved;
}

int ContactPipeline::correct(std::size_t cloth, const MovingCloth& moving,
                             std::span<const float> forces, double time_step,
                             ThreadTeam& team) noexcept {
  // Contacts between layers are soft: the response leaves them as solved.
  const std::span<const Contact> hard = finder_.hard_contacts(cloth);
  return responses_[cloth].respond(
      moving, {hard, forces.first(std::min(forces.size(), hard.size()))}, time_step, team);
}

FilterCounts ContactPipeline::filter(std::span<const MovingCloth> cloths, double time_step,
                                     ThreadTeam& team, FilterEnd end) noexcept {
  if (untangler_.crossings() > 0) {
    untangler_.move(cloths, time_step);
    world_.copy_to_mates(cloths);
  }
  const FilterCounts counts = filter_.run(cloths, time_step, StepFilter::Pass::end, team, end);
  struck_.keep(filter_.struck(), cloths, time_step);
  return counts;
}

void ContactPipeline::commit() noexcept {
  filter_.commit();
  struck_.commit();
  world_.commit();
}

void ContactPipeline::rollback() noexcept {
  filter_.rollback();
  world_.rollback();
}

void ContactPipeline::forget() noexcept {
  filter_.forget();
  world_.pairs().forget();
}

void ContactPipeline::end_frame() noexcept { struck_.end_frame(); }

void ContactPipeline::save_marks(std::size_t cloth, std::vector<int>& marks) const {
  world_.cloths[cloth].body_contacts->save(marks);
  for (std::size_t other = cloth; !marks.empty() && other < world_.cloths.size(); ++other)
    marks.push_back(untangler_.is_open(cloth, other) ? 1 : 0);
}

void ContactPipeline::restore_marks(std::size_t cloth, std::span<const int> marks) {
  const int size = world_.cloths[cloth].properties.size;
  const auto samples = static_cast<std::size_t>(size) * size;
  const std::size_t pairs = world_.cloths.size() - cloth;
  const bool known = marks.size() == samples + pairs;
  world_.cloths[cloth].body_contacts->restore(known ? marks.first(samples)
                                                    : std::span<const int>());
  for (std::size_t k = 0; k < pairs; ++k)
    untangler_.set_open(cloth, cloth + k, !known || marks[samples + k] != 0);
  for (BodyCrossings& crossings : world_.cloths[cloth].crossings) crossings.forget();
}

double ContactPipeline::smallest_gap(std::size_t cloth, const Planes3& positions,
                                     ThreadTeam& team) noexcept {
  WorldCloth& one = world_.cloths[cloth];
  world_.place_bodies(team);
  double least = HUGE_VAL;
  for (const ContactBody& body : world_.contact_bodies)
    least = std::min(least, one.body_contacts->smallest_gap(positions, body,
                                                            2 * one.properties.thickness, team));
  const int n = positions.size();
  for (int r = 0; world_.ground() != nullptr && r < n; ++r)
    for (int c = 0; c < n; ++c)
      least = std::min(least, double{positions.y(r, c)} - world_.ground()->height);
  return least;
}

}  // namespace weft
