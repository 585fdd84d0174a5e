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

/// A triangle as the local minimisation sees it: of mean square stretch m (half the sum of the
/// squared singular values) its energy is area * (m + quartic / 2 * m^2) + inverse * n, see
/// inverse_weight.
struct StarTriangle {
  SurfaceTriangle surface;
  double quartic = 0;  ///< >= 0; the larger, the more it counts how much the triangle is stretched
  double inverse = 0;  ///< >= 0; inverse_weight in units of the whole map
};

/// The triangles around one vertex, and the energy that they have together wherever the vertex is
/// put.
///
/// In the triangle of the vertex x and its neighbours a, b, with p = a - x and q = b - x, the mean
/// square stretch is m = n / (2 d^2) with n = g11 |q|^2 - 2 g12 p.q + g22 |p|^2, quadratic in x,
/// and d = cross(p, q), linear in x. The gradients n' and d' give, up to the half,
///   gradient m'  n' / d^2 - 2 n d' / d^3,
///   Hessian m''  n'' / d^2 - 2 (n' d'^T + d' n'^T) / d^3 + 6 n d' d'^T / d^4;
/// with half the second term and a third of the last it is that of a sum of squares. The energy's
/// are area * (1 + quartic m) m' + inverse n' and
/// area * ((1 + quartic m) m'' + quartic m' m'^T) + inverse n''.
class VertexStar {
 public:
  /// @param triangles  [F] as they are now
  /// @param uv         [D]
  void gather(const CollapseHierarchy& mesh, std::span<const StarTriangle> triangles,
              std::span<const Vec2d> uv, int vertex);

  /// Infinite where a triangle does not turn left.
  [[nodiscard]] double energy(Vec2d place) const;
  /// Whether all triangles turn left, by exact arithmetic.
  [[nodiscard]] bool is_valid(Vec2d place) const;
  /// How far along a step the first triangle closes, in steps.
  [[nodiscard]] double free_step_length(Vec2d place, Vec2d step) const;

  struct Model {
    double energy = 0;
    Vec2d gradient{};
    Symmetric2 hessian;  ///< the true one
    Symmetric2 squares;  ///< positive semidefinite, for where the true one is not positive
  };
  [[nodiscard]] Model model(Vec2d place) const;
  /// The neighbours, counter-clockwise. @pre inner vertex
  [[nodiscard]] std::vector<Vec2d> ring() const;

 private:
  /// A triangle, its metric on the edges to a and to b.
  struct Corner {
    Vec2d a, b;
    double g11, g12, g22, area, quartic, inverse;
  };
  std::vector<Corner> corners_;
};

/// A point in the midst of the kernel of a polygon, from which every edge turns left by exact
/// arithmetic; none if the kernel is empty or too thin for doubles.
/// @param ring  the polygon, counter-clockwise
std::optional<Vec2d> kernel_point(std::span<const Vec2d> ring);

/// Whether every edge of the polygon turns left seen from a point, by exact arithmetic.
bool sees_all(std::span<const Vec2d> ring, Vec2d point);

}  // namespace weft
