#pragma once

#include <vector>

#include "weft/cloth/cloth.h"

namespace weft::bench {

/// What most cloth programs do today, as a measure for the methods of this library: extended
/// position-based dynamics [macklin16] in small steps of one pass each [macklin19], over the same
/// springs with the same damping. Springs of one direction and colour share no particle and are
/// worked on a row at a time, side by side in vectors; rows along themselves are sorted into
/// streams first. One thread; sheets without mates.
class PositionBased {
 public:
  PositionBased(const Cloth& cloth, double step_seconds);

  void step(Vec3f gravity, ClothState& state);

 private:
  struct Line;
  struct Springs;
  [[nodiscard]] Line line(Planes3& position, int row, int first) const;
  void fall(Vec3f gravity, ClothState& state);
  void project_down(int direction, Planes3& position);
  void project_along(int direction, Planes3& position);
  void turn_into_velocity(ClothState& state) const;

  const Cloth& cloth_;
  float h_;
  std::vector<Grid<float>> compliance_, lag_;  // of each direction: 1 / (k h^2), c / (k h)
  Planes3 start_;
  std::vector<std::vector<float>> streams_;  // a row, sorted by columns modulo twice the reach
};

}  // namespace weft::bench
