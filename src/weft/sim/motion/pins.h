#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/scene.h"
#include "weft/vec.h"

namespace weft {

/// Pins that move together along a path.
struct PinMotion {
  std::vector<MotionKey> path;
  Vec3d centre;             ///< middle of the rest places [m]
  std::vector<int> pins;    ///< of the cloth
  std::vector<Vec3d> rest;  ///< [pins] rest places [m]
};

/// Pins places of a cloth at their rest positions. A sample that several places name is held by the
/// last.
/// @return the places that have a path
/// @throws SceneError when a region holds no sample
std::vector<PinMotion> pin_places(Cloth& cloth, std::span<const ScenePin> places);

/// Sets the targets of moving pins at a time.
void move_pins(std::span<const PinMotion> motions, double seconds, Cloth& cloth);

/// Largest speed of any of these pins [m/s].
double fastest_pin(std::span<const PinMotion> motions);

/// Pins the samples of one place at their rest positions.
/// @return indices of the cloth's pins that hold them, ascending  @throws SceneError as pin_places
std::vector<int> pin_place(Cloth& cloth, const PinPlace& place);
/// Removes pins from the motions, as something else moves them from now on.
void let_go(std::span<const int> held, std::vector<PinMotion>& motions);

/// Visits the samples beside those of a pin in the grid, each by visit(sample of the pin, row,
/// col).
template <class Visit>
void for_each_beside(const Cloth& cloth, const Pin& pin, const Visit& visit) {
  const int n = cloth.size;
  const auto try_at = [&](int copy, int down, int right) {
    const int r = copy / n + down, c = copy % n + right;
    if (std::min(r, c) < 0 || std::max(r, c) >= n) return;
    if (cloth.mates.same_chart(copy, r * n + c)) visit(copy, r, c);
  };
  for (const int copy : pin.copies) {
    if (!cloth.is_held_at(pin, copy)) continue;
    try_at(copy, -1, 0);
    try_at(copy, 1, 0);
    try_at(copy, 0, -1);
    try_at(copy, 0, 1);
  }
}

/// The sample nearest to a point of the unit square.
int sample_at(int size, Vec2d uv);

struct SimulatedCloth;

/// As fast as a hand moves cloth. [m/s]
inline constexpr double hand_speed = 3;

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
