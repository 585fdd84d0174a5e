#pragma once

#include <algorithm>
#include <vector>

#include "weft/cloth/integrator.h"

namespace weft::bench {

/// A vector a sample, row by row: [n * n].
using Field = std::vector<Vec3d>;

inline double dot(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += weft::dot(a[i], b[i]);
  return sum;
}

/// y += factor x
inline void add(double factor, const Field& x, Field& y) {
  for (std::size_t i = 0; i < x.size(); ++i) y[i] += factor * x[i];
}

inline double largest(const Field& field) {
  double max = 0;
  for (const Vec3d v : field) max = std::max(max, length(v));
  return max;
}

/// What moves, in double. [m], [m/s]
struct TightState {
  Field position, velocity;
};
TightState tight_state(const ClothState& state);

/// The energies of a cloth without seams that is flat at rest, and their derivatives, in double and
/// by plain loops: the model of `newton`, written down a second time. Damping is that of springs'
/// lengths over a step, c (l - l before)^2 / (2 h).
class TightEnergy {
 public:
  /// @throws SceneError for seams or a curved rest shape
  explicit TightEnergy(const Cloth& cloth);

  /// Springs with their limit, and bending [J].
  [[nodiscard]] double elastic(const Field& position) const;
  /// The most that a spring of stretch is longer than at rest, over its rest length.
  [[nodiscard]] double largest_strain(const Field& position) const;
  [[nodiscard]] double mass(int sample) const { return mass_[sample]; }  ///< [kg]
  [[nodiscard]] double total_mass() const { return total_mass_; }        ///< [kg]
  [[nodiscard]] bool moves(int sample) const { return moves_[sample] != 0; }

  /// Starts a step: y = x0 + h v0 + h^2 g. Pins stay where they are.
  void begin(const StepInput& input, const TightState& start);
  /// E(x) = |x - y|^2_M / (2 h^2) + springs + damping + bending [J].
  [[nodiscard]] double step_energy(const Field& position) const;
  /// dE/dx, 0 where pinned [N].
  void gradient(const Field& position, Field& out) const;
  enum class Hessian { exact, positive_part };
  /// Takes the Hessian at a position for product(); of its positive part springs that are shorter
  /// than at rest have no stiffness across.
  void linearise(const Field& position, Hessian hessian);
  /// out = A x, 0 where pinned. [x: m, out: N]
  void product(const Field& x, Field& out) const;

 private:
  struct Spring {
    int from = 0, to = 0;
    double rest_length = 0, stiffness = 0, damping = 0;
    bool stretch = false;
    double limit_length = 0;  // beyond it stiffer; 0: never
    double length_before = 0;
    double across = 0;  // t of the block t 1 + s s^T
    Vec3d along{};      // s
  };
  /// A term of (M x)_from.
  struct Curvature {
    int from = 0, to = 0;
    double weight = 0;  // [sqrt(N/m)]
  };
  struct Edge {
    int from = 0, to = 0;
    double stiffness = 0;  // [N/m]
  };
  void add_springs(const Cloth& cloth);
  void add_bending(const Cloth& cloth);
  [[nodiscard]] double spring_energy(const Field& position, bool with_damping) const;
  [[nodiscard]] double bending_energy(const Field& position) const;
  [[nodiscard]] double tension(const Spring& spring, double length) const;
  void add_bending_product(const Field& x, Field& out) const;
  void clear_pins(Field& field) const;

  std::vector<Spring> springs_;
  std::vector<Curvature> curvatures_;
  std::vector<Edge> edges_;
  std::vector<double> mass_;
  std::vector<char> moves_;
  Field wanted_;          // y
  mutable Field curved_;  // M x
  double step_ = 0, total_mass_ = 0;
};

/// The largest error of TightEnergy's gradient against central differences, over its largest
/// component, and of its product against differences of the gradient.
struct DerivativeErrors {
  double gradient = 0, product = 0;
};
DerivativeErrors check_derivatives();

}  // namespace weft::bench
