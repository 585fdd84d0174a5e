#pragma once

#include <optional>

#include "apps/viewer/orbit_camera.h"
#include "apps/viewer/snapshot.h"

namespace weft::viewer {

/// Where a ray meets a grid's triangles first.
struct GridHit {
  double distance = 0;  ///< from the ray's start [m]
  int sample = 0;       ///< the corner of the triangle that is nearest
};
/// Every cell is two triangles, seen from both sides. @param positions [n x n] [m]
std::optional<GridHit> meet_grid(const Ray& ray, const Planes3& positions);

/// What of the cloths a ray meets before anything else.
struct ClothHit {
  std::size_t cloth = 0;
  int sample = 0;
  Vec3d point;  ///< where the sample is [m]
};
std::optional<ClothHit> pick_cloth(const Ray& ray, const Snapshot& snapshot);

}  // namespace weft::viewer
