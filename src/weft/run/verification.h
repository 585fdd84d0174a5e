#pragma once

#include <cstdint>
#include <vector>

#include "weft/run.h"
#include "weft/run/passings.h"
#include "weft/sim/loading/insides.h"

namespace weft {

/// Verifies every step of a simulation and the end of every frame, independently of its collider:
/// surfaces that pass through each other by continuous detection, cloth that closed bodies swallow
/// by winding numbers.
class Verifier final : public StepWatcher {
 public:
  /// @param simulation  at its start; kept by reference
  Verifier(const Simulation& simulation, std::optional<double> ground);
  void see(const StepMotion& step) override { passed_ += passings_.count(step); }
  /// Notes which samples are now on the correct side of closed bodies.
  void begin() { count_swallowed(); }
  /// Adds the counts of a finished frame.
  void count_frame(int frame, Verification& found);

 private:
  /// A cloth and a closed body.
  struct Sides {
    std::size_t cloth = 0;
    ClosedBody body;
    bool kept_in = false;
    std::vector<char> right;  // [n * n] whether a sample has been on the correct side
  };
  std::int64_t count_swallowed();

  const Simulation& simulation_;
  PassingCheck passings_;
  std::vector<Sides> sides_;
  std::vector<char> inside_;
  ThreadTeam alone_{1};
  std::int64_t passed_ = 0;  // in this frame
};

}  // namespace weft
