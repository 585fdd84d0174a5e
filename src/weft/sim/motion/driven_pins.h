#pragma once

#include <span>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/sim/motion/attachments.h"
#include "weft/sim/motion/pins.h"
#include "weft/simulation.h"

namespace weft {

/// How far a pin may go ahead of the samples beside it in a step, in rest lengths.
inline constexpr double max_pin_lead = 0.5;

/// The pins of a cloth: those that paths and bodies move, and those that stand, but for what
/// collisions hold them back.
class DrivenPins {
 public:
  using Bodies = std::span<const Planes3* const>;

  /// A step that pins are to go along with.
  struct Step {
    double begin = 0, end = 0;  ///< [s]
    Bodies from, to;            ///< positions of bodies at both; null where one does not move
  };

  /// @param paths, tied  kept by reference
  /// @param bodies       of the scene: null where one does not move, which drives no pins
  /// @param cloth        whose pins have their first targets; follow() takes its state
  DrivenPins(std::span<const PinMotion> paths, std::span<const TiedPin> tied, Bodies bodies,
             const Cloth& cloth);

  /// Sets the targets to the end of a step, from the cloth's state at its start. A pin that
  /// collisions have held back makes up for it by `hand_speed`: at once it would be flung.
  void follow(const Step& step, SimulatedCloth& cloth);
  /// Gives pins that stand the places where they are to be as targets again, or where a hand has
  /// put them since.
  void return_standing(Cloth& cloth);
  /// Number of equal parts of the step that the targets ask for: in one, no pin goes ahead of the
  /// samples beside it, were these free, by more than `max_pin_lead` of the rest length between
  /// them. In a longer step springs would be stretched so far that their linearisation says
  /// nothing about them.
  /// @pre follow() has set the targets  @param seconds  length of the step
  [[nodiscard]] double wanted_subdivisions(const SimulatedCloth& cloth, double seconds) const;

 private:
  /// A pin that nothing moves, except by hand.
  struct Standing {
    std::size_t pin = 0;  // of the cloth
    Vec3d place;
    Vec3d put;  // target that follow() left; a hand may have changed it since
  };
  void place(double seconds, Bodies bodies, Cloth& cloth) const;

  std::span<const PinMotion> paths_;
  std::span<const TiedPin> tied_;
  std::vector<Standing> standing_;
  std::vector<Vec3d> lags_;  // [pins of the cloth] scratch [m]
};

}  // namespace weft
