#pragma once

#include <memory>
#include <span>
#include <vector>

#include "weft/core/thread_team.h"
#include "weft/sim/motion/body_motion.h"

namespace weft {

/// The bodies of a scene on their ways, in its order.
class DrivenBodies {
 public:
  void add(BodyMotion motion);
  /// Finds where each is at the end of a step.
  void move_to(double seconds, ThreadTeam& team) noexcept;

  /// Where each is at the end of the step. [n x n] world [m]; null where it stands still
  [[nodiscard]] std::span<const Planes3* const> ends() const { return ends_; }
  [[nodiscard]] bool any_moves() const;
  /// The fastest that any of them goes. [m/s]
  [[nodiscard]] double fastest() const;

 private:
  std::vector<BodyMotion> motions_;
  std::vector<std::unique_ptr<Planes3>> places_;  // null where a body stands still
  std::vector<const Planes3*> ends_;
};

}  // namespace weft
