#pragma once

#include <optional>
#include <span>
#include <vector>

#include "weft/mesh/stretch.h"
#include "weft/param/collapse_hierarchy.h"
#include "weft/vec.h"

namespace weft {

/// A symmetric 2 x 2 matrix.
struct Symmetric2 {
  double xx = 0, xy = 0, yy = 0;

  [[nodiscard]] double determinant() const { return xx * yy - xy * xy; }
  [[nodiscard]] bool is_positive() const { return xx > 0 && determinant() > 0; }
  /// @pre not singular
  [[nodiscard]] Vec2d solve(Vec2d rhs) const;
  [[nodiscard]] double along(Vec2d d) const {
    return xx * d.x * d.x + 2 * xy * d.x * d.y + yy * d.y * d.y;
  }
  /// Adds scale / 2 * (a b^T + b a^T).
  void add(double scale, Vec2d a, Vec2d b);
};

/// Energy of a triangle in the local minimisation: with mean square stretch m (half the sum of the
/// squared singular values) it is area * (m + quartic / 2 * m^2) + inverse * n, see inverse_weight.
struct StarTriangle {
  SurfaceTriangle surface;
  double quartic = 0;  ///< >= 0; weight of the quartic term
  double inverse = 0;  ///< >= 0; weight of the inverse term: inverse_weight times unit^2
};

/// The triangles around one vertex and their energy as a function of its position.
///
/// In the triangle of the vertex x and its neighbours a, b, with p = a - x and q = b - x, the mean
/// square stretch is m = n / (2 d^2) with n = g11 |q|^2 - 2 g12 p.q + g22 |p|^2, quadratic in x,
/// and d = cross(p, q), linear in x. The gradients n' and d' give, up to the half,
///   gradient m'  n' / d^2 - 2 n d' / d^3,
///   Hessian m''  n'' / d^2 - 2 (n' d'^T + d' n'^T) / d^3 + 6 n d' d'^T / d^4;
/// with half the second term and a third of the last, m'' is that of a sum of squares and thus
/// positive semidefinite. The gradient of the energy is area * (1 + quartic m) m' + inverse n', its
/// Hessian area * ((1 + quartic m) m'' + quartic m' m'^T) + inverse n''.
class VertexStar {
 public:
  /// Sets memory aside, so that `gather` allocates none at vertices of so many triangles.
  void reserve(int triangles) { corners_.reserve(triangles); }
  /// @param triangles  [F] as they are now
  /// @param uv         [D]
  void gather(const CollapseHierarchy& mesh, std::span<const StarTriangle> triangles,
              std::span<const Vec2d> uv, int vertex);

  /// Energy with the vertex at `place`; infinite where a triangle is not positively oriented.
  [[nodiscard]] double energy(Vec2d place) const;
  /// Whether all triangles are positively oriented, by exact arithmetic.
  [[nodiscard]] bool is_valid(Vec2d place) const;
  /// Step length, in units of `step`, at which the first triangle degenerates; infinity if none
  /// does.
  [[nodiscard]] double free_step_length(Vec2d place, Vec2d step) const;

  struct Model {
    double energy = 0;
    Vec2d gradient{};
    Symmetric2 hessian;  ///< exact
    Symmetric2 squares;  ///< positive semidefinite, for where `hessian` is not positive definite
  };
  [[nodiscard]] Model model(Vec2d place) const;
  /// The neighbours' positions, counter-clockwise. @pre inner vertex
  [[nodiscard]] std::vector<Vec2d> ring() const;

 private:
  /// A triangle by its neighbours a and b and the metric on its edges to them.
  struct Corner {
    Vec2d a, b;
    double g11, g12, g22, area, quartic, inverse;
  };
  std::vector<Corner> corners_;
};

/// A central point of the kernel of a polygon, checked by exact arithmetic; none if the kernel is
/// empty or too thin for doubles.
/// @param ring  the polygon, counter-clockwise
std::optional<Vec2d> kernel_point(std::span<const Vec2d> ring);

/// Whether a point is inside the kernel of a polygon (strictly to the left of every edge), by exact
/// arithmetic.
bool sees_all(std::span<const Vec2d> ring, Vec2d point);

}  // namespace weft
