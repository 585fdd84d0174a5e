#include "weft/image_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "weft/geometry_image.h"
#include "weft/mesh/distance.h"
#include "weft/mesh/topology.h"

namespace weft {
namespace {

void set_topology(ImageQuality& quality, const GeometryImage& image, const TriangleMesh& rebuilt) {
  const TopologyCounts counts =
      count_topology(static_cast<int>(rebuilt.positions.size()), rebuilt.triangles);
  quality.mates_bit_equal = mates_bit_equal(image);
  quality.euler = counts.euler;
  quality.boundaries = counts.boundaries;
}

double diagonal(const TriangleMesh& mesh) {
  Box3d box;
  for (const Vec3d p : mesh.positions) box.add(p);
  return box.diagonal();
}

}  // namespace

ImageQuality measure_topology(const GeometryImage& image) {
  ImageQuality quality;
  set_topology(quality, image, rebuild_mesh(image).mesh);
  return quality;
}

ImageQuality measure_image(const GeometryImage& image, const TriangleMesh& mesh,
                           const MeasureOptions& options) {
  const TriangleMesh rebuilt = rebuild_mesh(image).mesh;
  ImageQuality quality;
  set_topology(quality, image, rebuilt);
  const SurfaceDistance distance = surface_distance(
      mesh, rebuilt,
      {.seed = options.seed, .threads = options.threads, .progress = options.progress});
  quality.from_mesh = distance.from_first;
  quality.from_image = distance.from_second;
  const double size = diagonal(mesh);
  quality.psnr_db = distance.rms > 0 ? 20 * std::log10(size / distance.rms) : best_psnr_db;
  quality.psnr_db = std::min(quality.psnr_db, best_psnr_db);
  quality.hausdorff_percent = size > 0 ? 100 * distance.hausdorff / size : 0;
  return quality;
}

}  // namespace weft
