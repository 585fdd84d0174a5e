// The stages of a step, each for all cloths or for one; simulation_step.cpp has their order.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "weft/cloth/cloth.h"
#include "weft/core/contact_point.h"
#include "weft/core/stopwatch.h"
#include "weft/error.h"
#include "weft/sim/stepping/cloth_gaps.h"
#include "weft/sim/stepping/simulation_parts.h"

namespace weft {
namespace {

/// Rounds of strain limiter and collision response for the two-level method. Its springs are so
/// soft that the limiter carries the cloth and pulls it into bodies, and the response stretches it
/// again; so both alternate, the response last.
constexpr int rounds_of_soft_springs = 4;
/// Strain limit of the two-level method where the material has none: its springs are not those of
/// the material. [zink07]
constexpr double strain_of_soft_springs = 0.05;

/// Whether the limiter works as the paper prints it, where a method has the choice.
bool is_as_printed(const IntegratorOptions& options) {
  return std::visit(
      [](const auto& chosen) {
        if constexpr (requires { chosen.as_printed; })
          return chosen.as_printed;
        else
          return false;
      },
      options);
}

LimitOptions limit_for(const Scene& scene, const Cloth& cloth) {
  const IntegratorTraits traits = Integrators::traits_of(scene.integrator);
  const int suitable = std::clamp(cloth.size / 2, traits.min_passes, traits.max_passes);
  LimitOptions limit{traits.has_limiter ? scene.limiter_passes.value_or(suitable) : 0};
  if (!traits.soft_springs) return limit;
  if (cloth.material.strain_limit == 0) limit.strain = strain_of_soft_springs;
  limit.as_printed = is_as_printed(scene.integrator);
  return limit;
}
/// Passes of the limiter on each coarse level.
constexpr int coarse_passes = 2;

/// Depth in an obstacle, as a part of the thickness, beyond which a point is pushed out even after
/// a solve with contacts, as after an impact that went on beyond the last detection.
constexpr double harmless_depth = 0.75;

/// How far pins may go ahead of cloth in a step, as a part of what its substep was divided for,
/// before the step is divided further.
constexpr double max_excess_lead = 1.5;

/// Displacements, as parts of the smallest gap. A solve that moved less than same_place from the
/// filtered guess needs no second detection: contacts are found from half a gap before they press.
/// A guess that moves less than next_to_start passes through nothing that is not closer.
constexpr double same_place = 0.25, next_to_start = 0.05;

/// Leaves this part of the velocity of all that is not pinned.
void slow_down(const Cloth& cloth, double kept, Planes3& velocity) {
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c)
      if (cloth.inverse_mass(r, c) > 0)
        velocity.set(r, c, static_cast<float>(kept) * velocity.at(r, c));
}

}  // namespace

void Simulation::Parts::bodies_arrive() {
  moved_to.reset();
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].moves) bodies[i].positions = *driven.ends()[i];
}

void Simulation::Parts::move_bodies(double seconds) {
  if (!driven.any_moves() || moved_to == seconds) return;
  driven.move_to(seconds, team);
  collider->move_bodies(driven.ends(), team);
  moved_to = seconds;
}

void Simulation::Parts::resume_bodies() {
  std::vector<double> frame_ends;
  for (int past = 1; past <= frame; ++past)
    frame_ends.push_back(substep_time * (past * scene.substeps));
  buried.note_moved_before(frame_ends, team);
  driven.move_to(frame_start(), team);
  bodies_arrive();
  buried.recheck(team);
}

void Simulation::Parts::follow_buried() {
  if (!driven.any_moves()) return;
  driven.move_to(frame_end(), team);
  moved_to.reset();
  buried.begin_frame(*collider, team);
}

void Simulation::Parts::move_driven(double seconds) {
  move_bodies(seconds);
  const DrivenPins::Step step{step_start, seconds, body_starts, driven.ends()};
  for (std::size_t i = 0; i < cloths.size(); ++i) driven_pins[i].follow(step, cloths[i]);
  if (grab.holds()) grab.move(time_step, scene.ground, cloths[grab.cloth()]);
}

void Simulation::Parts::propose(std::size_t index) {
  SimulatedCloth& cloth = cloths[index];
  Mover& mover = movers[index];
  mover.air_work = mover.pulled_work = 0;
  if (has_air() || garments.is_sewn(index)) mover.calm_velocity = cloth.state.velocity;
  if (garments.any_sewn()) mover.unsewn_energy = mover.meter.measure(cloth.state).total();
  if (garments.is_sewn(index)) sew(index);
  const double gravity_part = garments.gravity_part(index, step_start);
  if (has_air() && gravity_part == 1) meet_air(index);
  mover.integrator->begin({time_step, vec_cast<float>(gravity_part * scene.gravity)}, cloth.state);
  if (!mover.integrator->starts_at_proposal()) mover.integrator->iterate({});
}

void Simulation::Parts::meet_air(std::size_t index) {
  const Cloth& model = *cloths[index].model;
  ClothState& state = cloths[index].state;
  Mover& mover = movers[index];
  energy.forget();
  const double before = mover.meter.kinetic(state.velocity);
  if (mover.wind) mover.wind->blow(time_step, state, solvers());
  // Where seams are open sewing damps.
  if (scene.air_damping > 0 && !garments.is_sewn(index))
    slow_down(model, 1 / (1 + scene.air_damping * time_step), state.velocity);
  mover.air_work = mover.meter.kinetic(state.velocity) - before;
}

void Simulation::Parts::sew(std::size_t index) {
  energy.forget();
  Integrator& integrator = *movers[index].integrator;
  garments.pull(index, {time_step, step_start, integrator.past_contacts()});
  integrator.forget();
}

double Simulation::Parts::follow_sewing() {
  const Garments::Changes changes =
      garments.begin_frame(frame_start(), substep_time * scene.substeps);
  if (changes.fabric) renew_movers();
  if (changes.fabric || changes.contact) energy.forget();
  if (!changes.contact) return changes.work;
  std::vector<std::vector<int>> marks(cloths.size());
  for (std::size_t i = 0; i < cloths.size(); ++i) collider->save_marks(i, marks[i]);
  const std::span<const StruckContact> struck = collider->struck();
  const std::vector<StruckContact> kept(struck.begin(), struck.end());
  make_collider_of_scene();
  for (std::size_t i = 0; i < cloths.size(); ++i) collider->restore_marks(i, marks[i]);
  collider->restore_struck(kept);
  return changes.work;
}

void Simulation::Parts::renew_movers() {
  std::vector<Mover> old;
  old.swap(movers);
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    movers.push_back(make_mover(i));
    movers[i].runaway = old[i].runaway;
    movers[i].integrator->restore_past(old[i].integrator->past_contacts());
  }
  join_movers();
}

bool Simulation::Parts::is_pulled(std::size_t index) const {
  const SimulatedCloth& cloth = cloths[index];
  if (soft || cloth.model->material.strain_limit <= 0) return false;
  const auto& pins = cloth.model->pins;
  return driven.any_moves() || std::any_of(pins.begin(), pins.end(), [&](const Pin& pin) {
           return vec_cast<float>(pin.target) != cloth.state.position.at(pin.sample);
         });
}

int Simulation::Parts::respond(std::size_t index) {
  const std::span<const float> forces = movers[index].integrator->contact_forces();
  const std::span<const Contact> obstacles = collider->obstacle_contacts(index);
  const double harmless = harmless_depth * cloths[index].model->material.thickness;
  const auto is_deep = [&](const Contact& contact) {
    return depth_of(contact, moving[index].position) > harmless;
  };
  if (!movers[index].integrator->solves_contacts() ||
      std::any_of(obstacles.begin(), obstacles.end(), is_deep))
    return collider->correct(index, moving[index], forces, time_step, team);
  const std::span<const float> pressing = forces.first(std::min(forces.size(), obstacles.size()));
  return static_cast<int>(
      std::count_if(pressing.begin(), pressing.end(), [](float force) { return force > 0; }));
}

int Simulation::Parts::correct(std::size_t index, ClothState& next, FrameReport& report) {
  const SimulatedCloth& cloth = cloths[index];
  Mover& mover = movers[index];
  Stopwatch clock;
  LimitOptions limiter = limit_for(scene, *cloth.model);
  if (unlimited) limiter.passes = 0;
  mover.limited = limiter.passes > 0 && strain_limit_of(limiter, cloth.model->material) > 0;
  LimitOptions coarse_limiter = limiter;
  coarse_limiter.passes = std::min(coarse_passes, limiter.passes);
  int contacts = 0;
  for (int round = 0; round < (soft ? rounds_of_soft_springs : 1); ++round) {
    if (mover.coarse_limit) mover.coarse_limit->limit(coarse_limiter, time_step, next, solvers());
    report.limit_ms += clock.lap_ms();
    const bool pulled = is_pulled(index);
    const double before = pulled ? mover.meter.measure(next).total() : 0;
    clock.lap_ms();
    // Displacements of the limiter change velocities as over a whole substep: over a short step the
    // same displacement would add an excessive velocity.
    mover.limit.limit(limiter, substep_time, next, solvers());
    report.limit_ms += clock.lap_ms();
    if (watched || pulled) mover.solved = mover.meter.measure(next);
    mover.pulled_work += pulled ? std::max(0.0, mover.solved.total() - before) : 0;
    clock.lap_ms();
    const int touched = respond(index);
    report.collide_ms += clock.lap_ms();
    contacts = std::max(contacts, touched);
    if (touched == 0) break;
  }
  return contacts;
}

void Simulation::Parts::gather_moving() {
  moving.clear();
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    ClothState& next = movers[i].integrator->proposal();
    moving.push_back(
        {cloths[i].state.position, next.position, next.velocity, cloths[i].model->inverse_mass});
  }
}

double Simulation::Parts::wanted_by_pins() const {
  double wanted = 1;
  for (std::size_t i = 0; i < cloths.size(); ++i)
    wanted = std::max(wanted, driven_pins[i].wanted_subdivisions(cloths[i], time_step));
  return wanted;
}

int Simulation::Parts::subdivisions_of(double begin, double end) {
  step_start = begin;
  time_step = substep_time;
  move_driven(end);
  const int of_bodies = driven.any_moves() ? approach.subdivisions(approached()) : 1;
  return std::max(of_bodies, whole_subdivisions(wanted_by_pins()));
}

int Simulation::Parts::required_level(int subdivisions) {
  const int of_bodies =
      driven.any_moves() ? approach.required_level(approached(), subdivisions) : -1;
  const double wanted = wanted_by_pins();
  if (wanted <= max_excess_lead || subdivisions == max_subdivisions) return of_bodies;
  return std::max(of_bodies, level_of(whole_subdivisions(wanted * subdivisions)));
}

std::span<const Contact> Simulation::Parts::contacts_of(std::size_t index) {
  const std::span<const Contact> found = collider->contacts(index),
                                 sewn = garments.contacts_between_seams(index);
  if (sewn.empty()) return found;
  std::vector<Contact>& all = movers[index].contacts;
  all.assign(found.begin(), found.end());
  all.insert(all.end(), sewn.begin(), sewn.end());
  return all;
}

void Simulation::Parts::iterate_together() {
  own_contacts.clear();
  for (std::size_t i = 0; i < cloths.size(); ++i) own_contacts.push_back(contacts_of(i));
  joint->iterate(own_contacts, collider->shared_contacts());
}

void Simulation::Parts::iterate_all() {
  if (joint && !collider->shared_contacts().empty()) return iterate_together();
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    const std::span<const Contact> found = contacts_of(i);
    if (movers[i].integrator->starts_at_proposal() || (solves_contacts() && !found.empty()))
      movers[i].integrator->iterate(found);
  }
}

bool Simulation::Parts::guesses_go_far() const {
  for (std::size_t i = 0; i < cloths.size(); ++i)
    if (largest_displacement(moving[i].start, moving[i].position) >
        next_to_start * self_gap_of(*cloths[i].model))
      return true;
  return driven.any_moves();
}

bool Simulation::Parts::solves_go_far() const {
  for (std::size_t i = 0; i < cloths.size(); ++i)
    if (largest_displacement(movers[i].guess, moving[i].position) >
        same_place * self_gap_of(*cloths[i].model))
      return true;
  return false;
}

bool Simulation::Parts::free_guesses() {
  const bool filters = Colliders::traits_of(scene.collider).filters;
  if (!solves_contacts() && !filters) return false;
  collider->detect(moving, time_step, team);
  if (!filters || !solves_contacts() || !collider->anything_near()) return false;
  // Contacts are kept: they were detected from the step's start, along the longer unfiltered path.
  if (movers.front().integrator->starts_at_proposal() && guesses_go_far())
    collider->filter_guess(moving, time_step, team);
  for (std::size_t i = 0; i < cloths.size(); ++i) movers[i].guess = moving[i].position;
  return true;
}

void Simulation::Parts::show_step(FrameReport& report) const {
  Stopwatch clock;
  std::vector<StepMotion::Path> cloth_paths, body_paths;
  for (const MovingCloth& cloth : moving) cloth_paths.push_back({&cloth.start, &cloth.position});
  for (std::size_t i = 0; i < bodies.size(); ++i)
    body_paths.push_back(
        {&bodies[i].positions, bodies[i].moves ? driven.ends()[i] : &bodies[i].positions});
  watcher->see({cloth_paths, body_paths});
  report.milliseconds -= clock.lap_ms();
}

void Simulation::Parts::finish(std::size_t index, FrameReport& report) {
  const StepReport stepped = movers[index].integrator->end(cloths[index].state);
  report.forces_ms += 1000 * stepped.forces_seconds;
  report.solve_ms += 1000 * stepped.solve_seconds;
  report.iterations += stepped.iterations;
  report.residual = std::max(report.residual, stepped.residual);
}

}  // namespace weft
