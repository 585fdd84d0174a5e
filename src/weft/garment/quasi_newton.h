#pragma once

#include <deque>
#include <vector>

#include "weft/vec.h"

namespace weft {

using Vectors = std::vector<Vec2d>;

double dot_of(const Vectors& a, const Vectors& b);
/// to += factor * what.
void add_scaled(Vectors& to, double factor, const Vectors& what);

/// The limited-memory method of Broyden, Fletcher, Goldfarb and Shanno. [nocedal06]
class QuasiNewton {
 public:
  /// The direction of ascent; one descends against it. @param gradient  at the current point
  [[nodiscard]] Vectors direction(const Vectors& gradient) const;
  /// @param moved, turned  change of the point and of the gradient
  void learn(Vectors moved, Vectors turned);
  [[nodiscard]] bool knows_nothing() const { return pairs_.empty(); }
  void forget() { pairs_.clear(); }

 private:
  struct Pair {
    Vectors moved, turned;
    double product;
  };
  std::deque<Pair> pairs_;
};

}  // namespace weft
