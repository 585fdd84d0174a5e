#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "weft/cloth/energy_meter.h"
#include "weft/sim/stepping/mover.h"
#include "weft/simulation.h"

namespace weft {

/// The energy of all cloths beside the work done on them. Tells which steps add too much, and takes
/// what accepted ones add beyond a bound out of their motion.
class EnergyBudget {
 public:
  /// Both are kept by reference; movers may be replaced between steps.
  EnergyBudget(const std::vector<SimulatedCloth>& cloths, std::vector<Mover>& movers)
      : cloths_(cloths), movers_(movers) {}

  /// Measures the energy before the first frame.
  void begin_run();
  [[nodiscard]] const Energy& at_start() const { return at_start_; }

  /// To be called where states change other than by a step: their energies are measured anew.
  void forget() { known_ = false; }

  /// Finds how much energy cloths may have at the end of the step, and tells integrators what they
  /// may add in it. @pre air has acted
  void lend(bool sewing);

  /// Whether the linearisation errors of the solves exceed the energy limit: the step is too long.
  /// @param part  of a substep that the step takes
  [[nodiscard]] bool solve_is_lost(double part) const;

  /// Work of pins and bodies in a step. [J]
  struct StepWork {
    double solve = 0;   ///< by the forces before the filter
    double filter = 0;  ///< what the forces that the filter leaves would make more of it
  };
  /// What moves cloth in a step beside gravity and air.
  enum class Drive {
    none,    ///< all that cloth gains, in the solve too, is too much
    bodies,  ///< bodies or pins, whose work is known less well: only what follows the solve counts
    seams    ///< that are sewn: their work is not known
  };
  /// What response and filter did to the energy in a step.
  struct Added {
    double energy = 0;    ///< added [J]
    double work = 0;      ///< done by pins and bodies, also through the filter [J]
    double excess = 0;    ///< to be taken out if the step is accepted [J]
    double gone = 1;      ///< part of the step's way, where it was shortened
    bool unpaid = false;  ///< motion cannot give a good part of the excess back
    bool too_much = false;
    bool wild = false;  ///< far too much: the filter holds back what springs would tear away
    bool calm = false;  ///< far from too much
  };
  /// @pre the filter is done
  [[nodiscard]] Added measure_added(const StepWork& work, Drive drive);
  /// Goes only a part of a step that gained energy which its motion cannot give back: the filter
  /// left the whole straight path free, and at its start nothing is gained.
  /// @pre neither pins nor bodies move, which would meet cloth that lags behind
  /// @return what the shorter step adds
  Added shorten(const StepWork& work);
  /// Takes an excess out of the motion of each cloth in proportion to what it gained.
  void take_out(double excess);

  /// Counts the work of an accepted step, whose end energies are the start energies of the next.
  /// @param watched  whether these were measured
  void finish_step(double net_work, bool watched);
  /// Counts work that was done between steps. @param net  [J]
  void add_work(double net);
  /// Counts work that no spring accounts for, see WorkDone.
  void add_pulled(double energy) { work_.pulled += energy; }

  [[nodiscard]] const WorkDone& work() const { return work_; }
  /// Energy that contacts and the filter may lend all cloths [J].
  [[nodiscard]] double max_lent() const;
  void restore(const WorkDone& work) {
    work_ = work;
    forget();
  }

 private:
  /// The part of an excess that can be taken out [J].
  [[nodiscard]] double removable(double excess) const;

  const std::vector<SimulatedCloth>& cloths_;
  std::vector<Mover>& movers_;
  WorkDone work_;
  Energy at_start_;
  double max_energy_ = HUGE_VAL;  // of cloths at the end of the step, before its work [J]
  double lent_ = 0;               // part of it that contacts and the filter may lend [J]
  bool known_ = false;            // start energies of movers are up to date
};

}  // namespace weft
