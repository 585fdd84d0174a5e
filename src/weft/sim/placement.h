#pragma once

#include <array>

#include "weft/geometry_image.h"
#include "weft/scene.h"

namespace weft {

/// The affine map of a placement.
struct PlacementMap {
  std::array<Vec3d, 3> rows;         ///< of rotation times scale
  std::array<Vec3d, 3> normal_rows;  ///< of rotation times 1 / scale: for normals
  Vec3d translate;                   ///< [m]

  [[nodiscard]] Vec3d point(Vec3d p) const {
    return Vec3d{dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)} + translate;
  }
  [[nodiscard]] Vec3d normal(Vec3d n) const {
    return normalized(
        Vec3d{dot(normal_rows[0], n), dot(normal_rows[1], n), dot(normal_rows[2], n)});
  }
};
PlacementMap placement_map(const Placement& placement);

/// World positions of the samples of an image; mates are equal. [n x n] [m]
Planes3 placed_positions(const GeometryImage& image, const PlacementMap& map);
NormalMap placed_normals(const NormalMap& normals, const PlacementMap& map);

/// Bounding box of all samples. [m]
Box3d box_of(const Planes3& positions);

}  // namespace weft
