#pragma once

#include <optional>

#include "apps/viewer/orbit_camera.h"
#include "apps/viewer/snapshot.h"

namespace weft::viewer {

/// First intersection of a ray with the triangles of a grid.
struct GridHit {
  double distance = 0;  ///< from the ray's start [m]
  int sample = 0;       ///< nearest corner of the triangle
};
/// Intersects a ray with the cells of a grid, two triangles each, seen from both sides.
/// @param positions [n x n] [m]
std::optional<GridHit> meet_grid(const Ray& ray, const Planes3& positions);

/// The first sample of a cloth along a ray, not hidden by a body.
struct ClothHit {
  std::size_t cloth = 0;
  int sample = 0;
  Vec3d point;  ///< position of the sample [m]
};
std::optional<ClothHit> pick_cloth(const Ray& ray, const Snapshot& snapshot);

}  // namespace weft::viewer
