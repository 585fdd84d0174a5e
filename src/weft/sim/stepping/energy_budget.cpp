#include "weft/sim/stepping/energy_budget.h"

#include <algorithm>
#include <cmath>

#include "weft/cloth/cloth.h"
#include "weft/core/math.h"

namespace weft {
namespace {

/// A step adds too much when response and filter add more energy than max_added_part of the inner
/// energy of the solved cloths plus max_added [J/kg] times their mass. The linearisation error of
/// the solve has the same limit, by the inner energy at the step's start.
constexpr double max_added_part = 0.3, max_added = 0.01;
/// Linearisation errors split a substep into at most this many steps: in crushed cloth, whose
/// contacts want to separate at once, shorter steps are more violent.
constexpr double max_subdivisions_for_solves = 8;
/// A step that is too much is wild if what follows its solve stretches springs by this part of m g
/// times the cloth's side length. Such springs draw points many cells far at once, of which the
/// filter allows hardly a gap; only in the shortest steps do they draw them less. While seams are
/// sewn this alone is too much.
constexpr double wild_part = 0.1;
/// A step that adds less than this part of the limit is calm.
constexpr double calm_part = 0.2;

/// Energy that contacts and springs stretched by the filter may lend a cloth, as a part of m g
/// times its side length; the next solves release it. Removed from the motion at once, it would
/// stop whatever moves in a pile.
constexpr double lent_part = 0.003;

/// Part of that up to which energy may remain that velocities cannot give back; more makes a step
/// bad.
constexpr double max_unpaid_part = 0.25;

/// A step that gains energy is shortened to no less than this part of its way before it is not gone
/// at all.
constexpr double min_part = 1.0 / 8;

/// @param mass  [kg] @param density  [kg/m^2] @return [J]
double lent_energy(double mass, double density) {
  return lent_part * mass * standard_gravity * std::sqrt(mass / density);
}

/// Energy that a cloth gained in a step. [J]
double gain_of(const Mover& mover) {
  return std::max(0.0, mover.end.total() - mover.start.total());
}

/// The work of a step that also did `added` [J] after its solve. Springs that the filter stretched
/// pull at the step's end only, and the next solve releases them, so their force is not that of the
/// whole step: what pins and bodies did through the filter is at most what this added.
double work_of(const EnergyBudget::StepWork& work, double added) {
  return work.solve + std::clamp(work.filter, std::min(0.0, added), std::max(0.0, added));
}

/// Largest energy that a step may add. [J]
double limit_for(const Energy& within, double mass) {
  return max_added_part * within.inner() + max_added * mass;
}

/// Shortens the way from `start` to a proposal, and slows it as much.
void shorten_way(const Planes3& start, float part, ClothState& proposal) {
  for (int s = 0; s < start.size() * start.size(); ++s) {
    const Vec3f from = start.at(s);
    proposal.position.set(s, from + part * (proposal.position.at(s) - from));
    proposal.velocity.set(s, part * proposal.velocity.at(s));
  }
}

}  // namespace

double EnergyBudget::max_lent() const {
  double most = 0;
  for (std::size_t i = 0; i < cloths_.size(); ++i)
    most += lent_energy(movers_[i].meter.mass(), cloths_[i].model->material.density);
  return most;
}

void EnergyBudget::begin_run() {
  for (std::size_t i = 0; i < cloths_.size(); ++i)
    at_start_ += movers_[i].meter.measure(cloths_[i].state);
}

bool EnergyBudget::solve_is_lost(double part) const {
  double missed = 0, mass = 0;
  for (const Mover& mover : movers_) missed += mover.integrator->missed();
  if (!(missed > 0) || part < 1.5 / max_subdivisions_for_solves) return false;
  Energy start;
  for (std::size_t i = 0; i < cloths_.size(); ++i) {
    start += movers_[i].meter.measure(cloths_[i].state);
    mass += movers_[i].meter.mass();
  }
  return missed > limit_for(start, mass);
}

void EnergyBudget::lend(bool sewing) {
  double start = 0, mass = 0, explained = work_.net;
  for (std::size_t i = 0; i < cloths_.size(); ++i) {
    Mover& mover = movers_[i];
    if (!known_) mover.start = mover.meter.measure(cloths_[i].state);
    start += mover.start.total();
    mass += mover.meter.mass();
    explained += mover.air_work;
  }
  known_ = true;
  work_.least = std::min(work_.least, start - explained);
  lent_ = max_lent();
  max_energy_ = work_.least + explained + lent_;
  // Where seams move the cloth its energy tells nothing, and many linearisations would gain
  // nothing.
  const double left = sewing ? lent_ / lent_part : std::max(0.0, max_energy_ - start);
  for (Mover& mover : movers_) mover.integrator->lend(left * mover.meter.mass() / mass);
}

EnergyBudget::Added EnergyBudget::measure_added(const StepWork& work, Drive drive) {
  Energy start, solved, end;
  double mass = 0;
  for (std::size_t i = 0; i < cloths_.size(); ++i) {
    Mover& mover = movers_[i];
    start += mover.start;
    solved += mover.solved;
    mass += mover.meter.mass();
    mover.end = mover.meter.measure(mover.integrator->proposal());
    end += mover.end;
  }
  Added added{end.total() - solved.total()};
  added.work = work_of(work, added.energy);
  const double stretched = end.elastic - solved.elastic, wild = wild_part / lent_part * lent_;
  // What cloth gains while it is sewn is the work of its seams, which end it where they close; what
  // the filter stretches is not.
  if (drive == Drive::seams) {
    added.too_much = !(stretched <= wild);
    added.calm = stretched < calm_part * wild;
    return added;
  }
  double gained = end.total() - start.total() - added.work;
  if (drive != Drive::none) gained = std::min(gained, added.energy);
  const double limit = limit_for(solved, mass), fault = std::max(stretched, gained);
  added.excess = std::max(0.0, std::min(gained, end.total() - added.work - max_energy_));
  added.unpaid = added.excess - removable(added.excess) > max_unpaid_part * lent_;
  added.too_much = !(fault <= limit) || added.unpaid;
  added.wild = added.too_much && stretched > wild;
  added.calm = fault < calm_part * limit;
  return added;
}

EnergyBudget::Added EnergyBudget::shorten(const StepWork& work) {
  Added added;
  double part = 1;
  do {
    const double next = part > min_part ? part / 2 : 0;
    for (std::size_t i = 0; i < cloths_.size(); ++i)
      shorten_way(cloths_[i].state.position, static_cast<float>(next / part),
                  movers_[i].integrator->proposal());
    part = next;
    added = measure_added(work, Drive::none);
    added.gone = part;
  } while (added.unpaid && part > 0);
  return added;
}

double EnergyBudget::removable(double excess) const {
  double gained = 0, removed = 0;
  for (const Mover& mover : movers_) gained += gain_of(mover);
  for (const Mover& mover : movers_)
    if (gained > 0)
      removed += std::min(excess * (gain_of(mover) / gained), mover.end.kinetic - mover.end.drift);
  return removed;
}

void EnergyBudget::take_out(double excess) {
  double gained = 0;
  for (const Mover& mover : movers_) gained += gain_of(mover);
  for (Mover& mover : movers_)
    if (gain_of(mover) > 0)
      mover.meter.take_out(excess * (gain_of(mover) / gained),
                           mover.integrator->proposal().velocity);
  // The remaining energy is measured anew, not computed, as a resumed run would do.
  forget();
}

void EnergyBudget::finish_step(double net_work, bool watched) {
  known_ = known_ && watched;
  for (Mover& mover : movers_) mover.start = mover.end;
  add_work(net_work);
}

void EnergyBudget::add_work(double net) {
  work_.net += net;
  work_.gross += std::abs(net);
}

}  // namespace weft
