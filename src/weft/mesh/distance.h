#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "weft/mesh.h"
#include "weft/mesh_statistics.h"
#include "weft/progress.h"

namespace weft {

/// The closest point on a mesh.
struct ClosestPoint {
  Vec3d position;
  int triangle = -1;
  double squared_distance = HUGE_VAL;
};

/// Closest points on a mesh, by a bounding-volume hierarchy that is built once.
class ClosestPointQuery {
 public:
  /// Keeps a copy of what it needs. @pre at least one triangle
  explicit ClosestPointQuery(const TriangleMesh& mesh);
  ClosestPointQuery(ClosestPointQuery&&) noexcept;
  ClosestPointQuery& operator=(ClosestPointQuery&&) noexcept;
  ~ClosestPointQuery();
  /// The closest point; of several triangles equally close, the first one's.
  /// @param hint  a triangle that may be near, for speed: the answer does not depend on it
  [[nodiscard]] ClosestPoint closest(Vec3d point, int hint = 0) const;
  /// Whether any triangle that is accepted has a point within a distance.
  [[nodiscard]] bool any_within(Vec3d point, double distance,
                                const std::function<bool(int triangle)>& accept) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// Closest point on one triangle.
Vec3d closest_on_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c);

/// Points spread evenly over the surface: one in each of `count` equal shares of its area, in the
/// order of the triangles. @pre at least one triangle
std::vector<Vec3d> sample_surface(const TriangleMesh& mesh, int count, std::uint64_t seed);

struct SurfaceDistance {
  double rms = 0;        ///< the larger of the two one-sided root mean squares [m]
  double hausdorff = 0;  ///< the larger of the two one-sided maxima [m]
  OneSidedDistance from_first, from_second;
};
struct DistanceOptions {
  int samples = 40000;  ///< area-uniform samples on each surface
  std::uint64_t seed = 1;
  int threads = 1;
  Progress* progress = nullptr;  ///< updated every few thousand samples
};
/// Distances between two surfaces, in both directions, by area-uniform samples and all vertices.
SurfaceDistance surface_distance(const TriangleMesh& a, const TriangleMesh& b,
                                 const DistanceOptions& options = {});
/// The same with a query of the first that is made already.
SurfaceDistance surface_distance(const TriangleMesh& a, const ClosestPointQuery& near_a,
                                 const TriangleMesh& b, const DistanceOptions& options = {});

}  // namespace weft
