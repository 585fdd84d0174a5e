// Construction of a simulation from its surfaces: attachments, movers and the collider.
#include <algorithm>

#include <fmt/format.h>

#include "weft/cloth/cloth.h"
#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/image/diagonals.h"
#include "weft/scene_file.h"
#include "weft/sim/placement.h"
#include "weft/sim/stepping/simulation_parts.h"
#include "weft/simulation.h"

namespace weft {

namespace {

/// The gap grows from the thickness of the fabric to this part of the cloth's rest spacing, so that
/// the gentle curvature of a body does not show through between two samples, but to no more than a
/// few thicknesses, or coarse cloths would float.
constexpr double gap_in_spacings = 1.0 / 3, max_gap_in_thicknesses = 3;

/// Largest gap between parts of cloth, in rest spacings; a larger one would lock folds.
constexpr double max_self_gap_in_spacings = 0.25;

/// Part of a cloth that may begin exactly on another one: a few rows find their way apart.
constexpr double max_part_in_one_place = 0.05;

/// Friction coefficient of the ground, which scenes do not set.
constexpr double ground_friction = 0.5;

}  // namespace

double self_gap_of(const Cloth& cloth) {
  return std::min(cloth.material.thickness, max_self_gap_in_spacings * cloth.rest_spacing);
}

double gap_of(const Cloth& cloth) {
  const double thickness = cloth.material.thickness;
  return std::clamp(gap_in_spacings * cloth.rest_spacing, thickness,
                    max_gap_in_thicknesses * thickness);
}

void Simulation::Parts::check_apart() {
  // Baselines take the start as it is.
  if (cloths.size() < 2 || !Colliders::traits_of(scene.collider).filters) return;
  make_check();
  for (std::size_t j = 1; j < cloths.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const double part = std::max(check->part_lying_on(i, j), check->part_lying_on(j, i));
      if (part <= max_part_in_one_place) continue;
      const double gap = self_gap_of(*cloths[i].model) + self_gap_of(*cloths[j].model);
      throw SceneError(
          name,
          fmt::format("cloths '{}' and '{}' begin in the same place: {:.0f} % of one lies exactly "
                      "on the other, and which is above nobody can tell",
                      cloths[i].name, cloths[j].name, 100 * part),
          fmt::format("cloths that begin {:.2g} m apart, or more, are wanted", gap / 2));
    }
}

void Simulation::Parts::make_collider_of_scene() {
  Obstacles obstacles;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    obstacles.bodies.push_back({bodies[i].positions, bodies[i].image.mates,
                                scene.bodies[i].friction, choose_diagonals(bodies[i].image)});
    if (bodies[i].moves)
      obstacles.bodies.back().shape =
          placed_positions(bodies[i].image, placement_map(scene.bodies[i].placement));
  }
  obstacles.ground = scene.ground;
  obstacles.ground_friction = ground_friction;
  std::vector<CollidingCloth> colliding;
  max_approach_in_step = HUGE_VAL;
  sliding.resize(cloths.size());
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    const SimulatedCloth& cloth = cloths[i];
    max_approach_in_step =
        std::min(max_approach_in_step, max_approach_in_gaps * gap_of(*cloth.model));
    sliding[i] = slides(i) ? 1 : 0;
    const double friction = sliding[i] != 0 ? 0 : scene.cloths[i].friction;
    colliding.push_back({cloth.model->together(), cloth.model->size, choose_diagonals(cloth.image),
                         gap_of(*cloth.model), friction, cloth.model->rest_spacing,
                         Colliders::traits_of(scene.collider).self_collision &&
                             scene.cloths[i].self_collision.value_or(true),
                         self_gap_of(*cloth.model), &cloth.model->rest, start_sides[i].kept_in,
                         start_sides[i].wrong_side,
                         cloth.model->apart ? &cloth.model->mates : nullptr,
                         cloth.garment != nullptr});
  }
  collider = make_collider(scene.collider, obstacles, colliding);
  collider->share_contacts(joint != nullptr);
}

void Simulation::Parts::make_check() {
  for (const SimulatedCloth& cloth : cloths)
    checked_triangles.push_back(joined_triangles(cloth.image));
  for (const PlacedBody& body : bodies) checked_triangles.push_back(joined_triangles(body.image));
  std::vector<GridTriangles> checked_cloths, checked_bodies;
  auto triangles = checked_triangles.cbegin();
  for (const SimulatedCloth& cloth : cloths)
    checked_cloths.push_back(
        {&cloth.state.position, &*triangles++, cloth.garment ? &cloth.garment->sewn : nullptr});
  for (const PlacedBody& body : bodies) checked_bodies.push_back({&body.positions, &*triangles++});
  check.emplace(checked_cloths, checked_bodies, scene.ground);
}

void Simulation::Parts::note_too_fast() {
  if (driven.fastest() * substep_time <= max_pieces * max_approach_in_step) return;
  notes.push_back(fmt::format(
      "bodies go up to {:.4g} m/s, faster than cloth can be kept from them; {} substeps "
      "or more are wanted",
      driven.fastest(),
      std::ceil(driven.fastest() / (scene.frame_rate * max_pieces * max_approach_in_step))));
}

Mover Simulation::Parts::make_mover(std::size_t index) {
  const SimulatedCloth& cloth = cloths[index];
  const Cloth& model = *cloth.model;
  const StepInput typical{substep_time, vec_cast<float>(scene.gravity)};
  return {make_integrator(scene.integrator, model, typical, solvers()),
          scene.wind ? std::optional<Wind>(std::in_place, *scene.wind, model) : std::nullopt,
          RunawayCheck(model, cloth.state, scene.gravity, drive_of(index)),
          StrainLimit(model, solvers()),
          soft ? std::optional<CoarseLimit>(std::in_place, model, solvers()) : std::nullopt,
          EnergyMeter(model, scene.gravity, solvers(), stiffens()),
          DrivenWork(model, scene.gravity, solvers(), stiffens()),
          Energy{},
          Energy{},
          Energy{},
          Planes3(scene.wind || cloth.garment ? model.size : 0),
          Planes3(model.size)};
}

void Simulation::Parts::join_movers() {
  std::vector<Integrator*> all;
  for (const Mover& mover : movers) all.push_back(mover.integrator.get());
  if (all.size() > 1) joint = all.front()->join(all, team);
}

void Simulation::Parts::make_movers() {
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    movers.push_back(make_mover(i));
    if (const std::string caution = movers.back().integrator->caution(); !caution.empty())
      notes.push_back(fmt::format("{}: {}", cloths[i].name, caution));
  }
  join_movers();
  own_contacts.reserve(cloths.size());
  moving.reserve(cloths.size());
  int largest = min_image_size;
  for (const SimulatedCloth& cloth : cloths) largest = std::max(largest, cloth.model->size);
  reach = ClothReach(largest);
  for (std::size_t i = 0; i < cloths.size(); ++i)
    start_energy += movers[i].meter.measure(cloths[i].state);
}

double Simulation::Parts::drive_of(std::size_t index) const {
  return (scene.wind ? length(scene.wind->velocity) : 0) +
         std::max(fastest_pin(pin_motions[index]), driven.fastest());
}

}  // namespace weft
