#pragma once

#include <span>
#include <vector>

#include "weft/geometry_image.h"
#include "weft/grid.h"
#include "weft/mesh.h"

namespace weft {

/// End of a walk over a surface.
struct ClosestOnSurface {
  Vec3d position;                      ///< [m]
  int triangle = -1;                   ///< index into GridSurface::triangles
  double squared_distance = HUGE_VAL;  ///< [m^2]
};

/// A placed geometry image as triangles whose mates are joined, so that walks cross seams.
class GridSurface {
 public:
  /// @param positions  [n x n] world [m], mates equal
  GridSurface(const Planes3& positions, const BorderMates& mates);

  /// [F] corners as representative samples; triangles with a repeated corner are left out.
  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
  [[nodiscard]] Vec3d position(int sample) const { return vec_cast<double>(positions_[sample]); }
  /// True when every edge has two triangles: the surface has an inside.
  [[nodiscard]] bool closed() const { return closed_; }
  /// Bounding box of all samples. [m]
  [[nodiscard]] Box3d box() const { return box_; }

  /// Walks downhill over neighbouring samples from `seed` (a representative) to the nearest one,
  /// then over the triangles around it to the closest point. A local minimum: as good as its seed.
  [[nodiscard]] ClosestOnSurface descend(Vec3d point, int seed) const noexcept;
  /// Angle-weighted vertex normals, interpolated at a point of a triangle. Unit.
  [[nodiscard]] Vec3d normal_at(int triangle, Vec3d point) const noexcept;

 private:
  void join_triangles(const Planes3& positions, const BorderMates& mates);
  void find_incident();
  void find_normals();
  [[nodiscard]] bool every_edge_has_two_triangles() const;
  [[nodiscard]] std::span<const int> incident(int sample) const {
    return std::span(incident_).subspan(starts_[sample], starts_[sample + 1] - starts_[sample]);
  }
  [[nodiscard]] int nearest_sample(Vec3d point, int seed) const noexcept;

  std::vector<Vec3f> positions_, normals_;  // [n * n]
  std::vector<Triangle> triangles_;
  std::vector<int> starts_, incident_;  // triangles around each representative, compressed rows
  Box3d box_;
  bool closed_ = false;
};

/// The weights of a triangle's corners at a point of its plane; thirds for a triangle without area.
Vec3d barycentric(Vec3d point, Vec3d a, Vec3d b, Vec3d c);

}  // namespace weft
