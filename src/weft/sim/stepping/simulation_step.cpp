// Time stepping of a simulation.
//
// Each step:
// 0. Pins, hands and bodies go to where they are at its end.
// 1. Seams that are being sewn are pulled together, air acts, and integrators guess positions
//    without the cloth's own forces.
// 2. Contacts are detected, and the collider filters the guesses, so that the solve starts without
//    crossings. Springs know no orientation: solved from beyond a crossing, cloth comes to rest
//    there, and the filter would stretch it back.
// 3. Integrators solve; where that moved cloth far, contacts are detected and solved for again.
// 4. Strain is limited, and points are pushed out of obstacles, with friction.
// 5. Samples of seams that have nearly met are put in one place, and the collider filters the
//    proposals, which is the last change of positions.
// A step to which the filter adds much energy, or that fails otherwise, is refused: the state
// before it is restored, and two steps of half the length replace it. One that gains energy while
// nothing moves the cloth, and may not be halved, is gone a part of its way.
#include <algorithm>
#include <cmath>

#include "weft/core/stopwatch.h"
#include "weft/sim/stepping/simulation_parts.h"

namespace weft {
namespace {

/// Largest number of times that a bad step which may not be halved is solved again, with contacts
/// for what the filter held back.
constexpr int max_repeats = 2;

}  // namespace

void Simulation::Parts::substep(int number, FrameReport& report) {
  const double begin = substep_time * number, end = substep_time * (number + 1);
  int repeats = 0;
  StepWalk walk(level_of(subdivisions_of(begin, end)), levels);
  while (!walk.done()) {
    time_step = substep_time / walk.subdivisions();
    unlimited = walk.is_shortened();
    const int piece = walk.index() + 1;
    const double seconds = piece < walk.subdivisions() ? begin + time_step * piece : end;
    step_start = seconds - time_step;
    move_driven(seconds);
    if (const int level = required_level(walk.subdivisions()); level >= 0) {
      walk.require(level);
      continue;
    }
    const Tried tried = try_step(
        seconds,
        {garments.any_sewn() ? walk.may_halve_sewn() : walk.may_halve(), walk.may_halve_wild(),
         driven.any_moves() && walk.may_halve_fallen(), may_solve_again() && repeats < max_repeats},
        report);
    if (tried.refused) refuse_step();
    if (tried.repeat) {
      ++repeats;
    } else if (tried.refused) {
      walk.halve();
    } else {
      finish_step(tried, report);
      repeats = 0;
      walk.accept(tried.verdict);
    }
  }
  levels = walk.next(levels);
  for (std::size_t i = 0; i < cloths.size(); ++i) driven_pins[i].return_standing(*cloths[i].model);
}

Simulation::Parts::Tried Simulation::Parts::try_step(double seconds, StepChoices choices,
                                                     FrameReport& report) {
  Tried tried;
  solve_all(report);
  gather_moving();
  for (std::size_t i = 0; i < cloths.size(); ++i)
    tried.contacts += correct(i, movers[i].integrator->proposal(), report);
  tried.refused =
      !stability.check_proposals({frame, time_step, seconds, collider->crossings()},
                                 choices.halve_wild && (watched || may_solve_again()), solvers());
  if (tried.refused) return tried;
  close_seams();
  if (watched) tried.forces_work.solve = measure_driven_work();
  Stopwatch clock;
  tried.filtered = collider->filter(
      moving, time_step, team,
      choices.refuses_fallen() && watched ? FilterEnd::unless_falls : FilterEnd::whole);
  report.collide_ms += clock.lap_ms();
  if (watched) {
    if (tried.filtered.moved > 0)
      tried.forces_work.filter = measure_driven_work() - tried.forces_work.solve;
    assess_step(choices, tried);
    return tried;
  }
  tried.work = measure_driven_work();
  if (energy.solve_is_lost(time_step / substep_time)) {
    tried.refused = choices.halve;
    tried.verdict = StepVerdict::forced;
  }
  return tried;
}

void Simulation::Parts::close_seams() {
  if (!garments.any_sewn()) return;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    ClothState& next = movers[i].integrator->proposal();
    garments.close(i, next);
    if (watched) movers[i].solved = movers[i].meter.measure(next);
  }
}

void Simulation::Parts::solve_all(FrameReport& report) {
  for (std::size_t i = 0; i < cloths.size(); ++i) propose(i);
  gather_moving();
  Stopwatch clock;
  watched = free_guesses();
  report.collide_ms += clock.lap_ms();
  if (watched) energy.lend(garments.any_sewn());
  iterate_all();
  gather_moving();
  if (!watched || !solves_go_far()) return;
  clock.lap_ms();
  collider->detect_again(moving, time_step, team);
  report.collide_ms += clock.lap_ms();
  iterate_all();
}

void Simulation::Parts::assess_step(StepChoices choices, Tried& tried) {
  const EnergyBudget::Drive drive = drive_now();
  const bool sewing_now = drive == EnergyBudget::Drive::seams;
  EnergyBudget::Added added = energy.measure_added(tried.forces_work, drive);
  tried.work = added.work;
  // A step is bad, too, when points fall back to its start.
  const bool fallen = tried.filtered.fell_back > 0;
  const bool bad =
      fallen || added.too_much || (!sewing_now && energy.solve_is_lost(time_step / substep_time));
  const bool halve =
      (added.wild && choices.halve_wild) || (fallen ? choices.refuses_fallen() : choices.halve);
  // Seams pull whatever the step's length: contacts first, then shorter steps.
  tried.repeat =
      bad && (sewing_now || !halve) && choices.repeat && collider->learn_struck(moving, time_step);
  tried.refused = tried.repeat || (bad && halve);
  tried.verdict = fallen       ? StepVerdict::fallen
                  : bad        ? StepVerdict::forced
                  : added.calm ? StepVerdict::calm
                               : StepVerdict::near;
  // Bodies do work by way of the filter, too.
  if (driven.any_moves())
    tried.pushed = std::max(0.0, added.energy - (added.work - tried.forces_work.solve));
  if (tried.refused || added.excess <= 0) return;
  if (added.unpaid && drive == EnergyBudget::Drive::none) {
    added = energy.shorten(tried.forces_work);
    tried.work = added.work;
    tried.lost_time = (1 - added.gone) * time_step;
    // Shorter steps may well do: were there none, cloth would stand still here for ever.
    tried.verdict = StepVerdict::near;
  }
  if (added.excess > 0) energy.take_out(added.excess);
}

EnergyBudget::Drive Simulation::Parts::drive_now() const {
  if (garments.any_sewn()) return EnergyBudget::Drive::seams;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].moves && largest_displacement(bodies[i].positions, *driven.ends()[i]) > 0)
      return EnergyBudget::Drive::bodies;
  for (std::size_t i = 0; i < cloths.size(); ++i)
    for (const Pin& pin : cloths[i].model->pins)
      if (moving[i].position.at(pin.sample) != moving[i].start.at(pin.sample))
        return EnergyBudget::Drive::bodies;
  return EnergyBudget::Drive::none;
}

void Simulation::Parts::refuse_step() {
  collider->rollback();
  moved_to.reset();
  for (std::size_t i = 0; i < cloths.size(); ++i)
    if (has_air() || garments.is_sewn(i)) cloths[i].state.velocity = movers[i].calm_velocity;
  if (has_air()) energy.forget();
}

void Simulation::Parts::finish_step(const Tried& tried, FrameReport& report) {
  if (watcher != nullptr) show_step(report);
  collider->commit();
  double done = tried.work;
  energy.add_pulled(tried.pushed);
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    finish(i, report);
    done += movers[i].air_work;
    energy.add_pulled(movers[i].pulled_work);
  }
  if (garments.any_sewn()) done = work_of_sewing();
  energy.finish_step(done, watched);
  report.work += done;
  report.contacts = std::max(report.contacts, tried.contacts);
  report.self_contacts = std::max(report.self_contacts, collider->self_contacts());
  report.stopped = std::max(report.stopped, tried.filtered.stopped);
  report.fell_back = std::max(report.fell_back, tried.filtered.fell_back);
  report.whole_fell_back = std::max(report.whole_fell_back, tried.filtered.whole);
  report.lost_time += tried.lost_time;
  bodies_arrive();
}

}  // namespace weft
