#pragma once

#include <string>
#include <vector>

#include "weft/core/thread_team.h"
#include "weft/sim/stepping/energy_budget.h"
#include "weft/sim/stepping/mover.h"
#include "weft/simulation.h"

namespace weft {

/// Stops a run whose motion nothing explains.
class StabilityCheck {
 public:
  /// All are kept by reference. @param name  of the scene, for errors
  StabilityCheck(const std::string& name, const std::vector<SimulatedCloth>& cloths,
                 std::vector<Mover>& movers)
      : name_(name), cloths_(cloths), movers_(movers) {}

  /// The step that is looked at, or the last one of a frame.
  struct Now {
    int frame = 0;         ///< from 0
    double time_step = 0;  ///< [s]
    double end = 0;        ///< of the step, since the run's start [s]
    int crossings = 0;     ///< of cloths that are being taken apart
  };
  /// Looks at proposals before the filter, which would hide runaway motion.
  /// @return whether motion is sane
  /// @throws Unstable  where it is not, unless the step may be refused
  bool check_proposals(const Now& now, bool may_refuse, ThreadTeam& team);

  /// Looks for energy that nothing put in, frame by frame.
  /// @param own   kinetic and elastic energy of the cloths [J]
  /// @param held  by a hand, which bodies may hold the cloth back against: no energy is checked
  /// @throws Unstable
  void check_energy(const Now& now, const FrameReport& report, double own, bool held,
                    const EnergyBudget& budget);

  /// Consecutive frames with unexplained energy, up to the last one.
  [[nodiscard]] int frames_beyond() const { return frames_beyond_; }
  void restore(int frames_beyond) { frames_beyond_ = frames_beyond; }

 private:
  /// @param gained  beyond the work of forces [J]
  void check_strained(const Now& now, double p99, double gained, const WorkDone& work) const;
  [[noreturn]] void stop(const Now& now, std::size_t cloth, const std::string& found) const;
  [[nodiscard]] std::string advice_for(const Now& now, std::size_t cloth) const;
  [[nodiscard]] std::size_t wildest_cloth() const;

  const std::string& name_;
  const std::vector<SimulatedCloth>& cloths_;
  std::vector<Mover>& movers_;
  int frames_beyond_ = 0;
};

}  // namespace weft
