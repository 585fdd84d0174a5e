#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/mesh/topology.h"
#include "weft/param/stretch.h"

namespace weft {

/// What the interior maps of one disk have in common, computed once.
struct DiskGeometry {
  /// Keeps a reference to the disk, which must outlive it.
  explicit DiskGeometry(const DiskMesh& mesh);

  const DiskMesh& disk;
  HalfEdges edges;
  std::vector<std::array<double, 3>> sides;  ///< [F] floored lengths
  std::vector<SurfaceTriangle> surface;      ///< [F] the metric as it is

  [[nodiscard]] double stretch_l2(std::span<const Vec2d> uv) const;
};

/// Whether every triangle turns left, by exact arithmetic on the doubles as they are.
bool is_valid_map(std::span<const Triangle> triangles, std::span<const Vec2d> uv);

}  // namespace weft
