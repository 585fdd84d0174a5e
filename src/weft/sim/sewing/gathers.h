#pragma once

#include <vector>

#include "weft/cloth/cloth.h"

namespace weft {

/// The springs along a garment's seams that are shorter when sewn than the edges of their panels.
/// They are gathered while seams close: all at once, panels would crumple where they begin.
class Gathers {
 public:
  Gathers() = default;
  /// Gives the springs the lengths of the flat panels. @param cloth  as it is when sewn
  explicit Gathers(Cloth& cloth);

  /// Moves samples of edges that are gathered out of their panels by a trace, to both sides in
  /// turn, so that flat panels fold there, as cloth does, instead of being crushed in their plane.
  /// @param start  where panels begin [n x n] [m]
  void ripple(const Cloth& cloth, Planes3& start) const;
  /// Sets the rest lengths. @param closed  part of their distances by which seams have closed
  /// @return whether they are others than before
  bool gather(double closed, Cloth& cloth);
  /// The energy that the springs gain where the cloth is as seams close. [J]
  [[nodiscard]] double work(double from, double to, const Cloth& cloth,
                            const Planes3& position) const;

 private:
  struct Spring {
    int direction = 0, row = 0, col = 0;
    float flat = 0, gathered = 0;  // rest lengths [m]
  };
  static int stage_of(double closed);
  static float rest_length(const Spring& spring, int stage);

  std::vector<Spring> springs_;
  int stage_ = 0;
};

}  // namespace weft
