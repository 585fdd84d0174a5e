#pragma once

#include <array>
#include <optional>
#include <vector>

#include "weft/mesh/crossings.h"
#include "weft/mesh/distance.h"
#include "weft/param/square_map.h"

namespace weft {

/// A sample of an image, on the surface.
struct SurfaceSample {
  Vec3d position;  ///< [m]
  Vec3d normal;    ///< unit
  Vec2d place;     ///< in the map's units
};

/// A plane by a point of it.
struct PlaneAt {
  Vec3d position;  ///< [m]
  Vec3d normal;    ///< unit
};

/// The mapped surface, for samples that slide over it.
class SlidingSurface {
 public:
  /// Keeps a reference.
  explicit SlidingSurface(const MappedDisk& mapped);

  /// The sample where the surface is closest to its displaced position; nothing where that is the
  /// back of the surface, or its border.
  [[nodiscard]] std::optional<SurfaceSample> moved(const SurfaceSample& sample,
                                                   Vec3d displacement) const;

  /// The plane through the closest point of the surface, square to the way there.
  [[nodiscard]] PlaneAt foot(Vec3d point) const;

 private:
  [[nodiscard]] Corners corners(int triangle) const;
  [[nodiscard]] SurfaceSample at(const Triangle& t, const std::array<double, 3>& weights) const;

  const DiskMesh& disk_;
  const SquareMap& map_;
  std::vector<Vec3d> normals_;  // [D]
  ClosestPointQuery query_;
};

}  // namespace weft
