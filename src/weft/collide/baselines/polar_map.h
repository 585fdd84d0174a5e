#pragma once

#include <optional>

#include "weft/collide/baselines/polar_surface.h"
#include "weft/collide/baselines/polar_table.h"
#include "weft/collide/collider.h"

namespace weft {

/// Surface point of an obstacle from which a particle's gap is measured.
struct SurfacePoint {
  Vec3d position;  ///< x_s [m]
  Vec3d normal;    ///< n_s, unit, out of the obstacle
  double gap = 0;  ///< n_s . (x - x_s): negative inside [m]
};

/// Nearest surface points by the paper's polar map [zink07, section 5]: the body in its bounding
/// cube, a sphere around the cube's centre of radius sqrt(3)/2 sides (the printed sqrt(2)/2 misses
/// the corners), and an angular table of the triangles that rays from the centre meet.
class PolarMap {
 public:
  PolarMap(const Body& body, const PolarMapOptions& options);

  /// Contact of a particle with the body.
  /// @param point  where the particle is [m]
  /// @param start  where it was when the step began [m]; an open surface has no inside, so it only
  /// holds what can have crossed it during the step
  /// @param reach  gap at which contact begins [m]
  /// @return the surface point when the gap is below `reach`
  [[nodiscard]] std::optional<SurfacePoint> contact(Vec3d point, Vec3d start,
                                                    double reach) const noexcept;

  /// True when the ray from the centre leaves the (closed) body beyond the point an odd number of
  /// times.
  [[nodiscard]] bool inside(Vec3d point) const noexcept;

 private:
  /// Hits of the ray from the centre through a point.
  struct RadialHits {
    int beyond = 0;           ///< how many surfaces lie farther than the point
    int triangle = -1;        ///< of the hit nearest to the point, -1: none
    double radius = 0;        ///< of that hit [m]
    int nearest_sample = -1;  ///< of the cell's triangles, for starting a walk
  };
  [[nodiscard]] RadialHits radial_hits(Vec3d offset, double radius) const noexcept;
  [[nodiscard]] std::optional<SurfacePoint> printed(Vec3d offset, double radius,
                                                    const RadialHits& hits) const noexcept;
  [[nodiscard]] std::optional<SurfacePoint> walked(Vec3d point,
                                                   const RadialHits& hits) const noexcept;

  GridSurface surface_;
  double side_;
  Vec3d centre_;
  PolarTable table_;
  bool walk_;
};

}  // namespace weft
