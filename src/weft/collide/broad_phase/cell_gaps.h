#pragma once

#include "weft/collide/moving_surface.h"

namespace weft {

/// Gaps between two cells at both ends of a step, from their corners relative to one of them, so
/// that single precision suffices.
class CellGaps {
 public:
  CellGaps(const MovingSurface& a, int cell_a, const MovingSurface& b, int cell_b);
  /// Whether the direction between the cells or the normal of either certainly separates them, in
  /// the same order, by more than these gaps at the start and at the end. [m]
  [[nodiscard]] bool apart(double at_start, double at_end) const;
  /// Largest gap along the same directions that certainly holds at the start and at the end;
  /// negative or 0 where none does. [m]
  [[nodiscard]] float certain_gap() const;
  /// Corner of the first or second cell, relative to the common origin. [m]
  [[nodiscard]] Vec3f start(bool second, int corner) const {
    return at(second ? start_b_ : start_a_, corner);
  }
  [[nodiscard]] Vec3f end(bool second, int corner) const {
    return at(second ? end_b_ : end_a_, corner);
  }
  /// Generous bound of the rounding error of a gap. [m]
  [[nodiscard]] float margin() const { return margin_; }
  /// Whether the cosine between the cells' normals at the start exceeds `cosine`, in either
  /// direction.
  [[nodiscard]] bool parallel(float cosine) const;
  /// Upper bound of how much nearer any two points of the cells come in the step. [m]
  [[nodiscard]] double max_approach() const;

 private:
  using Four = float __attribute__((vector_size(16)));
  struct Corners {
    Four x, y, z;
  };
  /// The extents of both cells along a direction, at both ends of the step.
  struct Extents {
    Four lower, upper;
  };
  /// Order of the cells in Extents.
  enum : int { start_of_a, start_of_b, end_of_a, end_of_b };
  static Vec3f at(const Corners& of, int corner) {
    return {of.x[corner], of.y[corner], of.z[corner]};
  }
  static Corners corners(const Planes3& at, int row, int col, Vec3f origin);
  static Vec3f normal_of(const Corners& of);
  static Extents extents_of(Four* rows);
  [[nodiscard]] Extents along(Vec3f n) const;
  [[nodiscard]] Vec3f displacement() const;
  [[nodiscard]] bool apart_along(Vec3f n, float at_start, float at_end) const;
  [[nodiscard]] float gap_along(Vec3f n) const;

  Corners start_a_, end_a_, start_b_, end_b_;
  float margin_ = 0;
};

}  // namespace weft
