#include "weft/run/export/surface_points.h"

#include <numeric>

#include "weft/geometry_image.h"

namespace weft {

std::vector<Vec3f> SurfacePoints::gather(const Planes3& positions) const {
  std::vector<Vec3f> points;
  points.reserve(sample_of.size());
  for (const int sample : sample_of) points.push_back(positions.at(sample));
  return points;
}

SurfacePoints surface_points(const GeometryImage& image, bool unwelded) {
  SurfacePoints points;
  points.size = image.size();
  points.triangles = grid_triangles(image);
  if (unwelded) {
    points.sample_of.resize(static_cast<std::size_t>(points.size) * points.size);
    std::iota(points.sample_of.begin(), points.sample_of.end(), 0);
    points.vertex_of = points.sample_of;
  } else {
    RebuiltMesh rebuilt = rebuild_mesh(image);
    points.sample_of = std::move(rebuilt.sample_of);
    points.vertex_of = std::move(rebuilt.vertex_of);
  }
  return points;
}

}  // namespace weft
