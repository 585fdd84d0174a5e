#include "weft/sim/stepping/stability_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "weft/cloth/cloth.h"
#include "weft/cloth/measure.h"
#include "weft/error.h"

namespace weft {
namespace {

/// A run stops when its energy exceeds the start energy plus the work done on it by more than this,
/// by more than max_times_lent of what contacts may lend, which is much in cloth of 10 m, and by
/// more than max_unexplained_part of the energy that cloths can have come by.
constexpr double max_unexplained = 1;  // [J]
constexpr double max_times_lent = 2;
constexpr double max_unexplained_part = 0.05;
/// Uncertainty of the measured work, as a part of it, which is added to the second bound. It is
/// large for work done in few steps: after a jump of a pin, solves leave a good part of the forces
/// unbalanced.
constexpr double max_unexplained_work = 0.5;
/// Consecutive frames beyond these bounds after which a run stops. A single one does not count:
/// springs that the filter stretched in one frame relax in the next.
constexpr int frames_that_tell = 2;
/// Where the 99th percentile of spring strain is beyond this, one frame tells, and only the work of
/// forces explains energy, not what the filter added while bodies moved. Scenes may ask for as much
/// strain: then that work is there.
constexpr double max_strain = 1;

}  // namespace

std::string StabilityCheck::advice_for(const Now& now, std::size_t cloth) const {
  if (now.crossings > 0) return "cloths that begin apart, or less deep in each other, are wanted";
  const std::string advice = movers_[cloth].integrator->stability_advice(now.time_step);
  return advice.empty() ? "more substeps or a softer material are wanted" : advice;
}

void StabilityCheck::stop(const Now& now, std::size_t cloth, const std::string& found) const {
  throw Unstable(
      name_,
      fmt::format("cloth '{}' ran away at frame {}: {}", cloths_[cloth].name, now.frame + 1, found),
      advice_for(now, cloth), {now.frame + 1, cloths_[cloth].name});
}

namespace {

std::string motion_text(const ClothState& state, BadParticle bad) {
  const double speed = length(vec_cast<double>(state.velocity.at(bad.row, bad.col)));
  if (!std::isfinite(speed)) return "which is at no finite place";
  return fmt::format("which moves at {:.3g} m/s", speed);
}

}  // namespace

bool StabilityCheck::check_proposals(const Now& now, bool may_refuse, ThreadTeam& team) {
  for (std::size_t i = 0; i < cloths_.size(); ++i) {
    const std::string& cloth = cloths_[i].name;
    const ClothState& proposal = movers_[i].integrator->proposal();
    const auto bad = movers_[i].runaway.find(*cloths_[i].model, proposal, now.end, team);
    if (bad && may_refuse) return false;
    if (bad)
      throw Unstable(
          name_,
          fmt::format("cloth '{}' ran away at frame {}, particle (row {}, col {}), {}", cloth,
                      now.frame + 1, bad->row, bad->col, motion_text(proposal, *bad)),
          advice_for(now, i), {now.frame + 1, cloth, bad->row, bad->col});
  }
  return true;
}

std::size_t StabilityCheck::wildest_cloth() const {
  const auto wildest = std::max_element(
      cloths_.begin(), cloths_.end(), [](const SimulatedCloth& a, const SimulatedCloth& b) {
        return kinetic_energy(*a.model, a.state) < kinetic_energy(*b.model, b.state);
      });
  return static_cast<std::size_t>(wildest - cloths_.begin());
}

void StabilityCheck::check_strained(const Now& now, double p99, double gained,
                                    const WorkDone& work) const {
  const double most = std::max(max_unexplained, max_unexplained_part * work.gross);
  if (p99 <= max_strain || gained <= most) return;
  stop(
      now, wildest_cloth(),
      fmt::format("one spring of a hundred is strained by {:.0f} % or more, and the energy rose by "
                  "{:.3g} J beyond what pins, bodies and wind put in, {:.3g} J",
                  100 * p99, gained, work.net));
}

void StabilityCheck::check_energy(const Now& now, const FrameReport& report, double own, bool held,
                                  const EnergyBudget& budget) {
  const WorkDone& work = budget.work();
  const Energy& start = budget.at_start();
  const double energy = report.kinetic_energy + report.potential_energy;
  const double gained = energy - start.total() - work.net - work.pulled;
  // Upper bound on the kinetic and elastic energy that the cloths can have come by.
  const double fallen = std::max(0.0, start.total() - (energy - own));
  const double come_by = start.own() + fallen + work.pulled;
  const double most = max_unexplained_part * come_by + max_unexplained_work * work.gross;
  if (!held) check_strained(now, report.strain.p99, gained + work.pulled, work);
  const bool beyond =
      !held && gained > std::max({max_unexplained, max_times_lent * budget.max_lent(), most});
  frames_beyond_ = beyond ? frames_beyond_ + 1 : 0;
  if (frames_beyond_ < frames_that_tell) return;
  stop(now, wildest_cloth(),
       fmt::format("the energy rose by {:.3g} J beyond what pins, bodies and wind put in, "
                   "{:.3g} J",
                   gained, work.net));
}

}  // namespace weft
