#pragma once

#include <array>

#include "weft/collide/surface.h"

namespace weft {

/// The corners of two cells at both ends of a step, seen from one of them, so that single precision
/// tells their gaps.
class CellGaps {
 public:
  CellGaps(const MovingSurface& a, int cell_a, const MovingSurface& b, int cell_b);
  /// Whether the way between them or the normal direction of either certainly keeps them apart, in
  /// the same order, by more than so much at the start and at the end. [m]
  [[nodiscard]] bool apart(double at_start, double at_end) const;
  /// How far any two of their points may come nearer to each other in the step, at most. [m]
  [[nodiscard]] double most_approach() const;

 private:
  struct Corners {
    std::array<float, 4> x, y, z;
  };
  static Corners corners(const Planes3& at, int first, Vec3f origin);
  static Vec3f normal_of(const Corners& of);
  [[nodiscard]] Vec3f way() const;
  [[nodiscard]] bool apart_along(Vec3f n, float at_start, float at_end) const;

  Corners start_a_, end_a_, start_b_, end_b_;
  float farthest_ = 0;  // of all coordinates [m]
};

}  // namespace weft
