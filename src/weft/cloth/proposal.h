#pragma once

#include <chrono>

#include "weft/cloth/cloth.h"
#include "weft/cloth/integrator.h"

namespace weft {

/// Copies this worker's rows.
void copy_rows(const ClothState& from, ClothState& to, Worker& worker);

/// Puts every pinned sample at its target, with the velocity that takes it there in one step.
void set_pins(const Cloth& cloth, const ClothState& start, double time_step, ClothState& next);

/// Makes a proposal the state, after whatever was done to it; mates equal. Pins are where they were
/// left: a filter may have stopped them before their targets.
void accept(const Cloth& cloth, ClothState& next, ClothState& state, ThreadTeam& team);

/// Seconds since it was made.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::unique_ptr<Integrator> make_newton(const NewtonOptions& options, const Cloth& cloth,
                                        ThreadTeam& team);
std::unique_ptr<Integrator> make_explicit(const Cloth& cloth, const StepInput& typical,
                                          ThreadTeam& team);
std::unique_ptr<Integrator> make_implicit(const ImplicitOptions& options, const Cloth& cloth,
                                          ThreadTeam& team);
std::unique_ptr<Integrator> make_desbrun(const Cloth& cloth, const StepInput& typical,
                                         ThreadTeam& team);
std::unique_ptr<Integrator> make_two_level(const TwoLevelOptions& options, const Cloth& cloth,
                                           const StepInput& typical, ThreadTeam& team);
std::unique_ptr<Integrator> make_multigrid(const MultigridOptions& options, const Cloth& cloth,
                                           const StepInput& typical, ThreadTeam& team);

}  // namespace weft
