// The work of what holds cloth, see DrivenWork.
#include <algorithm>

#include "weft/sim/stepping/simulation_parts.h"

namespace weft {
namespace {

/// Ways go on through layers in this many rings of samples; farther from what holds a cloth it is
/// held by the same as the layers beside it.
constexpr int rings_across = 8;

}  // namespace

double Simulation::Parts::measure_driven_work() {
  bool moves = false;
  for (std::size_t i = 0; i < cloths.size(); ++i)
    moves = movers[i].driven_work.begin(
                {cloths[i].state, movers[i].integrator->proposal(), time_step},
                {collider->obstacle_contacts(i), movers[i].integrator->contact_forces()}) ||
            moves;
  if (!moves) return 0;
  spread_ways();
  double work = 0;
  for (std::size_t i = 0; i < cloths.size(); ++i)
    work += movers[i].driven_work.measure(
        {cloths[i].state, movers[i].integrator->proposal(), time_step},
        {!movers[i].limited, is_layered(i)});
  return work;
}

bool Simulation::Parts::is_layered(std::size_t index) const {
  const auto is_its = [index](const SharedContact& shared) {
    return shared.first == static_cast<int>(index) || shared.second == static_cast<int>(index);
  };
  const std::span<const SharedContact> shared = collider->shared_contacts();
  return collider->contacts(index).size() > collider->obstacle_contacts(index).size() ||
         std::any_of(shared.begin(), shared.end(), is_its);
}

void Simulation::Parts::spread_ways() {
  bool spreads = true;
  for (int ring = 0; spreads; ++ring) {
    if (ring < rings_across) hand_ways_over();
    spreads = ring < rings_across;
    for (std::size_t i = 0; i < cloths.size(); ++i)
      spreads = movers[i].driven_work.ways().spread() || spreads;
  }
}

void Simulation::Parts::hand_ways_over() {
  const auto ways = [&](std::size_t cloth) -> NearestWays& {
    return movers[cloth].driven_work.ways();
  };
  for (std::size_t i = 0; i < cloths.size(); ++i)
    for (const Contact& contact :
         collider->contacts(i).subspan(collider->obstacle_contacts(i).size()))
      hand_over(contact, ways(i), ways(i));
  for (const SharedContact& shared : collider->shared_contacts())
    hand_over(shared.contact, ways(static_cast<std::size_t>(shared.first)),
              ways(static_cast<std::size_t>(shared.second)));
}

/// All that cloths gained in a step of sewing is the work of the seams.
double Simulation::Parts::work_of_sewing() {
  double gained = 0;
  for (std::size_t i = 0; i < cloths.size(); ++i)
    gained += movers[i].meter.measure(cloths[i].state).total() - movers[i].unsewn_energy;
  return gained;
}

}  // namespace weft
