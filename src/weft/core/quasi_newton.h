#pragma once

#include <deque>
#include <functional>
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

struct DescentOptions {
  int max_steps = 60;
  double first_step = 0.1;  ///< displacement of the point that the first step moves most
  double still = 0;         ///< ends with a step that lowers the value by less than this part of it
};
/// Lowers a smooth function of points in the plane by that method, with steps that are halved until
/// they lower it enough.
/// @param measure  returns the value at its first argument, and puts the gradient into its second
/// @return the value at the end
double descend(const std::function<double(const Vectors&, Vectors&)>& measure, Vectors& at,
               const DescentOptions& options);

}  // namespace weft
