// Energy balance of a step with collisions: refuses steps that add too much energy, and removes
// what accepted ones add beyond a bound.
#include <algorithm>
#include <cmath>

#include "weft/cloth/cloth.h"
#include "weft/core/math.h"
#include "weft/sim/stepping/simulation_parts.h"

namespace weft {
namespace {

/// A step is refused when points fall back to its start, or when response and filter add more
/// energy than max_added_part of the inner energy of the solved cloths plus max_added [J/kg] times
/// their mass. The linearisation error of the solve has the same limit, by the inner energy at the
/// step's start.
constexpr double max_added_part = 0.3, max_added = 0.01;
/// Linearisation errors split a substep into at most this many steps: in crushed cloth, whose
/// contacts want to separate at once, shorter steps are more violent.
constexpr double max_pieces_for_solves = 8;
/// A step that adds less than this part of the limit is calm.
constexpr double calm_part = 0.2;

/// Energy that contacts and springs stretched by the filter may lend a cloth, as a part of m g
/// times its side length; the next solves release it. Removed from the motion at once, it would
/// stop whatever moves in a pile.
constexpr double lent_part = 0.003;

/// Part of that up to which energy may remain that velocities cannot give back; more makes a step
/// bad.
constexpr double max_unpaid_part = 0.25;

/// @param mass  [kg] @param density  [kg/m^2] @return [J]
double lent_energy(double mass, double density) {
  return lent_part * mass * standard_gravity * std::sqrt(mass / density);
}

/// Energy that a cloth gained in a step. [J]
double gain_of(const Mover& mover) {
  return std::max(0.0, mover.end.total() - mover.start.total());
}

/// Largest energy that a step may add. [J]
double limit_for(const Energy& within, double mass) {
  return max_added_part * within.inner() + max_added * mass;
}

}  // namespace

bool Simulation::Parts::solve_is_lost() {
  double missed = 0, mass = 0;
  for (const Mover& mover : movers) missed += mover.integrator->missed();
  if (!(missed > 0) || time_step < 1.5 * substep_time / max_pieces_for_solves) return false;
  Energy start;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    start += movers[i].meter.measure(cloths[i].state);
    mass += movers[i].meter.mass();
  }
  return missed > limit_for(start, mass);
}

void Simulation::Parts::lend() {
  double start = 0, mass = 0, most = 0, explained = work.net;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    Mover& mover = movers[i];
    if (!known_energy) mover.start = mover.meter.measure(cloths[i].state);
    start += mover.start.total();
    mass += mover.meter.mass();
    explained += mover.wind_work;
    most += lent_energy(mover.meter.mass(), cloths[i].model->material.density);
  }
  known_energy = true;
  work.least = std::min(work.least, start - explained);
  lent = most;
  max_energy = work.least + explained + most;
  // Where seams move the cloth its energy tells nothing, and many linearisations would gain
  // nothing.
  const double left = is_sewing() ? most / lent_part : std::max(0.0, max_energy - start);
  for (Mover& mover : movers) mover.integrator->lend(left * mover.meter.mass() / mass);
}

void Simulation::Parts::assess_step(StepChoices choices, Tried& tried) {
  Energy start, solved, end;
  double mass = 0;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    Mover& mover = movers[i];
    start += mover.start;
    solved += mover.solved;
    mass += mover.meter.mass();
    mover.end = mover.meter.measure(mover.integrator->proposal());
    end += mover.end;
  }
  const double added = end.total() - solved.total();
  const double gained = std::min(added, end.total() - start.total() - tried.work);
  const double limit = limit_for(solved, mass);
  // What cloth gains while it is sewn is the work of its seams, which end it where they close.
  const bool sewn = is_sewing();
  const double excess =
      sewn ? 0 : std::max(0.0, std::min(gained, end.total() - tried.work - max_energy));
  const bool unpaid = excess - removable(excess) > max_unpaid_part * lent;
  const double fault = std::max(end.elastic - solved.elastic, gained);
  const bool bad =
      tried.filtered.fell_back > 0 || (!sewn && (!(fault <= limit) || unpaid || solve_is_lost()));
  const bool fallen = tried.filtered.fell_back > 0;
  const bool halve = choices.halve || (fallen && choices.halve_fallen);
  tried.repeat = bad && !sewn && !halve && choices.repeat && collider->learn_struck(moving);
  tried.refused = tried.repeat || (bad && halve);
  tried.verdict = fallen                      ? StepVerdict::fallen
                  : bad                       ? StepVerdict::forced
                  : fault < calm_part * limit ? StepVerdict::calm
                                              : StepVerdict::near;
  // Bodies do work by way of the filter, too.
  if (driven.any_moves()) tried.pushed = std::max(0.0, added);
  if (tried.refused) return;
  if (excess > 0) take_excess(excess);
}

double Simulation::Parts::removable(double excess) const {
  double gained = 0, removed = 0;
  for (const Mover& mover : movers) gained += gain_of(mover);
  for (const Mover& mover : movers)
    if (gained > 0)
      removed += std::min(excess * (gain_of(mover) / gained), mover.end.kinetic - mover.end.drift);
  return removed;
}

/// Removes energy from the motion of each cloth in proportion to what it gained.
void Simulation::Parts::take_excess(double excess) {
  double gained = 0;
  for (const Mover& mover : movers) gained += gain_of(mover);
  for (Mover& mover : movers)
    if (gain_of(mover) > 0)
      mover.meter.take_out(excess * (gain_of(mover) / gained),
                           mover.integrator->proposal().velocity);
  // The remaining energy is measured anew, not computed, as a resumed run would do.
  known_energy = false;
}

}  // namespace weft
