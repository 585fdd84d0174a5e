#include "weft/convert/surface_places.h"

#include <cmath>
#include <limits>
#include <utility>

#include "weft/convert/border_walk.h"
#include "weft/convert/rasterise.h"
#include "weft/core/assert.h"

namespace weft {

namespace {

using Weights = std::array<double, 3>;

Weights blend(double rest, const Weights& a, double fraction, const Weights& b) {
  return {rest * a[0] + fraction * b[0], rest * a[1] + fraction * b[1],
          rest * a[2] + fraction * b[2]};
}

/// Expresses points of the disk in barycentric coordinates of the surface triangles that contain
/// them.
class PlacesOnSurface {
 public:
  PlacesOnSurface(const DiskMesh& disk, std::span<const Triangle> surface)
      : disk_(disk), surface_(surface) {
    WEFT_ASSERT(disk.surface_triangle.size() == disk.triangles.size());
  }

  [[nodiscard]] SurfacePlace at(int triangle, const Weights& weights) const {
    const int on = disk_.surface_triangle[triangle];
    SurfacePlace place{on, {}};
    for (int k = 0; k < 3; ++k)
      place.weights = blend(1, place.weights, weights[k],
                            weights_of(disk_.triangles[triangle][k], surface_[on]));
    return place;
  }

 private:
  /// @pre the vertex lies in the triangle
  [[nodiscard]] Weights weights_of(int vertex, const Triangle& on) const {
    if (static_cast<std::size_t>(vertex) < disk_.split_from.size()) {
      const EdgePlace& place = disk_.split_from[vertex];
      if (place.a >= 0)
        return blend(1 - place.fraction, weights_of(place.a, on), place.fraction,
                     weights_of(place.b, on));
    }
    Weights weights{};
    for (int k = 0; k < 3; ++k) weights[k] = on[k] == disk_.surface_vertex[vertex] ? 1 : 0;
    return weights;
  }

  const DiskMesh& disk_;
  std::span<const Triangle> surface_;
};

/// The triangles on the border edges of a disk.
class BorderTriangles {
 public:
  explicit BorderTriangles(const DiskMesh& disk)
      : disk_(disk), triangle_(disk.positions.size(), -1) {
    std::vector<int> next(disk.positions.size(), -1);
    for (std::size_t i = 0; i < disk.border.size(); ++i)
      next[disk.border[i]] = disk.border[(i + 1) % disk.border.size()];
    for (std::size_t t = 0; t < disk.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const int from = disk.triangles[t][k];
        if (next[from] >= 0 && next[from] == disk.triangles[t][(k + 1) % 3])
          triangle_[from] = static_cast<int>(t);
      }
  }

  /// A border triangle at a point of the border, and the barycentric coordinates of the point.
  [[nodiscard]] std::pair<int, Weights> at(const EdgePoint& point) const {
    int triangle = triangle_[point.from];
    // On a path walked backwards, the border edge starts at `to`.
    if (point.fraction > 0 && corner(triangle, point.to) < 0) triangle = triangle_[point.to];
    Weights weights{};
    weights[corner(triangle, point.from)] += 1 - point.fraction;
    if (point.fraction > 0) weights[corner(triangle, point.to)] += point.fraction;
    return {triangle, weights};
  }

 private:
  [[nodiscard]] int corner(int triangle, int vertex) const {
    const Triangle& t = disk_.triangles[triangle];
    return t[0] == vertex ? 0 : t[1] == vertex ? 1 : t[2] == vertex ? 2 : -1;
  }

  const DiskMesh& disk_;
  std::vector<int> triangle_;  ///< [D] on the border edge that starts at a vertex, -1 inside
};

}  // namespace

std::vector<SurfacePlace> surface_places(const MappedDisk& mapped,
                                         std::span<const Triangle> surface, ChartSize size) {
  const DiskMesh& disk = mapped.cut.disk;
  const PlacesOnSurface places(disk, surface);
  std::vector<SurfacePlace> found(static_cast<std::size_t>(size.rows) * size.cols);
  const BorderWalk border(mapped);
  const BorderTriangles along_border(disk);
  for (int t = 0; t < size.around(); ++t) {
    const auto [triangle, weights] = along_border.at(border.on_own_side(t, size));
    found[chart_sample(size, t, size.cols)] = places.at(triangle, weights);
  }
  rasterise(disk, mapped.map, size, [&](int row, int col, int triangle) {
    const Vec2d place = sample_place(row, col, size, mapped.map);
    found[static_cast<std::size_t>(row) * size.cols + col] =
        places.at(triangle, corner_weights(corner_uv(mapped.map, disk.triangles[triangle]), place));
  });
  return found;
}

std::vector<Vec2d> vertex_places(const MappedDisk& mapped, std::span<const int> source_vertex,
                                 int vertices) {
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  const std::vector<int>& points = mapped.cut.disk.surface_vertex;
  std::vector<Vec2d> places(static_cast<std::size_t>(vertices), Vec2d{nowhere, nowhere});
  for (std::size_t d = 0; d < points.size(); ++d) {
    // Higher indices are those of split vertices.
    if (std::cmp_greater_equal(points[d], source_vertex.size())) continue;
    Vec2d& place =
        places[static_cast<std::size_t>(source_vertex[static_cast<std::size_t>(points[d])])];
    if (!std::isfinite(place.x)) place = mapped.map.uv[d];
  }
  return places;
}

}  // namespace weft
