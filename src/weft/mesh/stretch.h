#pragma once

#include <span>
#include <vector>

#include "weft/mesh.h"

namespace weft {

/// The first fundamental form of a triangle of the surface, on its edges from corner 0 to 1 and
/// to 2.
struct SurfaceTriangle {
  double g11 = 0, g12 = 0, g22 = 0;  ///< dot products of the two edges [m^2]
  double area = 0;                   ///< [m^2]
};
/// [F]
std::vector<SurfaceTriangle> surface_triangles(std::span<const Vec3d> positions,
                                               std::span<const Triangle> triangles);

/// The singular values of the affine map from the plane to space on one triangle [sander01]: both
/// infinite for a triangle that has no area in the plane or is inverted. [m per unit of uv]
struct TriangleStretch {
  double largest = 0;
  double mean_square = 0;  ///< (largest^2 + smallest^2) / 2 = (a + c) / 2
};
TriangleStretch triangle_stretch(const SurfaceTriangle& surface, Vec2d a, Vec2d b, Vec2d c);

/// The stretch of a whole map, scaled so that a map that keeps lengths up to one factor has 1.
struct Stretch {
  double l2 = 0;
  double linf = 0;
};
/// @param uv  [D]
/// Triangles without area on the surface weigh nothing and are left out of both.
Stretch measure_stretch(std::span<const SurfaceTriangle> surface,
                        std::span<const Triangle> triangles, std::span<const Vec2d> uv);

/// The area-weighted root mean square stretch of the triangles around each vertex [yoshizawa04],
/// relative to that of the whole map and kept within [1e-4, 1e4], so that a weight divided by it
/// stays positive and finite even where the map has collapsed. [D]
std::vector<double> vertex_stretch(std::span<const SurfaceTriangle> surface,
                                   std::span<const Triangle> triangles, std::span<const Vec2d> uv);

}  // namespace weft
