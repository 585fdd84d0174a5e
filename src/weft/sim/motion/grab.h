#pragma once

#include <optional>

#include "weft/vec.h"

namespace weft {

struct Cloth;
struct SimulatedCloth;

/// A surface point of a cloth held by the user: a pin that follows a target.
class Grab {
 public:
  /// @throws SceneError for a sample outside the image
  void take(std::size_t cloth, int sample, SimulatedCloth& held);
  void pull(Vec3d target) { wanted_ = target; }
  /// Sets the target of the pin at the end of a step.
  /// @param time_step  [s]  @param ground  its height [m]
  void move(double time_step, std::optional<double> ground, SimulatedCloth& held) const;
  void let_go(Cloth& held);
  [[nodiscard]] bool holds() const { return pin_ >= 0; }
  [[nodiscard]] std::size_t cloth() const { return cloth_; }

 private:
  std::size_t cloth_ = 0;
  int pin_ = -1;        // of the cloth; -1: nothing is held
  bool added_ = false;  // whether the pin was added for this grab
  Vec3d wanted_;        // [m]
};

}  // namespace weft
