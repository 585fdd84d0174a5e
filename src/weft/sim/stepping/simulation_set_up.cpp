// Construction of a simulation from its surfaces: attachments, movers and the collider.
#include <algorithm>

#include <fmt/format.h>

#include "weft/cloth/cloth.h"
#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/image/diagonals.h"
#include "weft/scene_file.h"
#include "weft/sim/placement.h"
#include "weft/sim/stepping/cloth_gaps.h"
#include "weft/sim/stepping/simulation_parts.h"
#include "weft/simulation.h"

namespace weft {

namespace {

/// Friction coefficient of the ground, which scenes do not set.
constexpr double ground_friction = 0.5;

}  // namespace

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
  garments.note_sliding(frame_start());
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    const SimulatedCloth& cloth = cloths[i];
    const double friction = garments.is_sliding(i) ? 0 : scene.cloths[i].friction;
    colliding.push_back({cloth.model->together(), cloth.model->size, choose_diagonals(cloth.image),
                         gap_of(*cloth.model), friction, cloth.model->rest_spacing,
                         Colliders::traits_of(scene.collider).self_collision &&
                             scene.cloths[i].self_collision.value_or(true),
                         self_gap_of(*cloth.model), &cloth.model->rest, start_sides[i].kept_in,
                         start_sides[i].wrong_side,
                         cloth.model->apart ? &cloth.model->mates : nullptr});
  }
  collider = make_collider(scene.collider, obstacles, colliding);
  collider->share_contacts(joint != nullptr);
  buried.tell(*collider);
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
          Planes3(has_air() || cloth.garment ? model.size : 0),
          Planes3(model.size)};
}

void Simulation::Parts::join_movers() {
  std::vector<Integrator*> all;
  for (const Mover& mover : movers) all.push_back(mover.integrator.get());
  if (all.size() > 1) joint = all.front()->join(all, team);
}

void Simulation::Parts::make_movers() {
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    try {
      movers.push_back(make_mover(i));
    } catch (const SceneError& error) {
      // What suits no cloth of this size is known here first.
      throw SceneError(name, fmt::format("'{}': {}", cloths[i].name, error.what()), "");
    }
    if (const std::string caution = movers.back().integrator->caution(); !caution.empty())
      notes.push_back(fmt::format("{}: {}", cloths[i].name, caution));
  }
  join_movers();
  for (const PlacedBody& body : bodies)
    body_starts.push_back(body.moves ? &body.positions : nullptr);
  for (std::size_t i = 0; i < cloths.size(); ++i)
    driven_pins.emplace_back(pin_motions[i], tied_pins[i], body_starts, *cloths[i].model);
  own_contacts.reserve(cloths.size());
  moving.reserve(cloths.size());
  approach.set_up();
  energy.begin_run();
}

double Simulation::Parts::drive_of(std::size_t index) const {
  return (scene.wind ? length(scene.wind->velocity) : 0) +
         std::max(fastest_pin(pin_motions[index]), driven.fastest());
}

}  // namespace weft
