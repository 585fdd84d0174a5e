#pragma once

#include "weft/cloth/cloth.h"
#include "weft/garment.h"

namespace weft {

/// Brings together the samples of a garment's seams. In each step the samples of a class go towards
/// their mean, at a speed that falls with their distance; otherwise they move as one particle. What
/// holds one of them back, a body or other cloth, is waited for.
class Sewing {
 public:
  /// @param garment  kept by reference
  explicit Sewing(const Garment& garment) : garment_(garment) {}

  /// Sets the velocities of a state's seams for the next step: of each class the mean, and towards
  /// each other. @param seconds  since the start: seams set off gently
  void pull(double time_step, double seconds, ClothState& state) const;

  /// The part of gravity that acts on the cloth: none while seams close, but not for ever.
  [[nodiscard]] static double gravity_part(double seconds);

  /// Whether all samples that are to be sewn together are so close that nothing can be between.
  [[nodiscard]] bool is_closed(const Planes3& position) const;
  /// Puts the samples of every class at their mean, with their mean velocity.
  void close(ClothState& state) const;

  /// Of each seam the largest distance in a pair. [m]
  [[nodiscard]] std::vector<double> gaps(const Planes3& position) const;

 private:
  const Garment& garment_;
};

}  // namespace weft
