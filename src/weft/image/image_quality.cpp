#include "weft/image_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "weft/geometry_image.h"
#include "weft/mesh/crossings.h"
#include "weft/mesh/distance.h"
#include "weft/mesh/stretch.h"
#include "weft/mesh/topology.h"

namespace weft {

namespace {

void set_topology(ImageQuality& quality, const GeometryImage& image, const TriangleMesh& rebuilt) {
  const auto vertices = static_cast<int>(rebuilt.positions.size());
  const TopologyCounts counts = image.mates.keep_manifold()
                                    ? count_topology(vertices, rebuilt.triangles)
                                    : count_complex(vertices, rebuilt.triangles);
  quality.mates_bit_equal = mates_bit_equal(image);
  quality.euler = counts.euler;
  quality.boundaries = counts.boundaries;
}

Vec3d area_vector(const TriangleMesh& mesh, int triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3d p = mesh.positions[a];
  return 0.5 * cross(mesh.positions[b] - p, mesh.positions[c] - p);
}

double area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    area += length(area_vector(mesh, t));
  return area;
}

double diagonal(const TriangleMesh& mesh) { return box_of(mesh).diagonal(); }

/// Part of a surface's area that faces the other way than the triangle of another one closest to
/// it, by the centres of its triangles, or of evenly spread ones of many. Where walls of the other
/// lie on each other, facing both ways, nothing is reversed.
double reversed_part(const TriangleMesh& surface, const TriangleMesh& mesh,
                     const ClosestPointQuery& query) {
  constexpr int max_probes = 40000;
  const auto count = static_cast<int>(surface.triangles.size());
  const int step = (count + max_probes - 1) / max_probes;
  const double rounding = 1e-6 * diagonal(mesh);
  double area = 0, reversed = 0;
  int hint = 0;
  for (int t = 0; t < count; t += step) {
    const auto& [a, b, c] = surface.triangles[t];
    const auto& p = surface.positions;
    const Vec3d centre = (1.0 / 3) * (p[a] + p[b] + p[c]), own = area_vector(surface, t);
    const ClosestPoint near = query.closest(centre, hint);
    hint = near.triangle;
    area += length(own);
    const auto faces_alike = [&](int other) { return dot(own, area_vector(mesh, other)) >= 0; };
    if (!faces_alike(hint) &&
        !query.any_within(centre, std::sqrt(near.squared_distance) + rounding, faces_alike))
      reversed += length(own);
  }
  return area > 0 ? reversed / area : 0;
}

void set_folds(ImageQuality& quality, const TriangleMesh& rebuilt, const TriangleMesh& mesh,
               const ClosestPointQuery& query) {
  const double area = area_of(mesh);
  quality.area_ratio = area > 0 ? area_of(rebuilt) / area : 1;
  quality.reversed_area = reversed_part(rebuilt, mesh, query);
}

void set_distances(ImageQuality& quality, const TriangleMesh& other, const TriangleMesh& mesh,
                   const ClosestPointQuery& query, const MeasureOptions& options) {
  const SurfaceDistance distance = surface_distance(
      mesh, query, other,
      {.seed = options.seed, .threads = options.threads, .progress = options.progress});
  quality.from_mesh = distance.from_first;
  quality.from_image = distance.from_second;
  const double size = diagonal(mesh);
  quality.psnr_db = distance.rms > 0 ? 20 * std::log10(size / distance.rms) : best_psnr_db;
  quality.psnr_db = std::min(quality.psnr_db, best_psnr_db);
  quality.hausdorff_percent = size > 0 ? 100 * distance.hausdorff / size : 0;
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
  const ClosestPointQuery query(mesh);
  set_distances(quality, rebuilt, mesh, query, options);
  set_folds(quality, rebuilt, mesh, query);
  return quality;
}

ImageQuality measure_mesh(const TriangleMesh& other, const TriangleMesh& mesh,
                          const MeasureOptions& options) {
  ImageQuality quality;
  set_distances(quality, other, mesh, ClosestPointQuery(mesh), options);
  return quality;
}

ImageQuality measure_folds(const GeometryImage& image, const TriangleMesh& mesh) {
  const TriangleMesh rebuilt = rebuild_mesh(image).mesh;
  ImageQuality quality;
  set_topology(quality, image, rebuilt);
  set_folds(quality, rebuilt, mesh, ClosestPointQuery(mesh));
  return quality;
}

namespace {

struct Samples {
  std::vector<Vec3d> positions;  ///< world [n * n]
  std::vector<Vec2d> uv;         ///< (col, row)
};

Samples samples_of(const GeometryImage& image) {
  const int n = image.size();
  Samples samples;
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col) {
      samples.positions.push_back(image.world_position(row, col));
      samples.uv.push_back({static_cast<double>(col), static_cast<double>(row)});
    }
  return samples;
}

std::array<int, 2> quad_of(const Triangle& t, int n) {
  const auto [row_a, row_b] = std::minmax({t[0] / n, t[1] / n, t[2] / n});
  const auto [col_a, col_b] = std::minmax({t[0] % n, t[1] % n, t[2] % n});
  return {row_a, col_a};
}

}  // namespace

ImageStatistics examine_image(const GeometryImage& image) {
  const Samples samples = samples_of(image);
  const std::vector<Triangle> triangles = grid_triangles(image);
  const std::vector<SurfaceTriangle> surface = surface_triangles(samples.positions, triangles);
  ImageStatistics statistics;
  for (const Vec3d p : samples.positions) statistics.box.add(p);
  for (int k = 0; k < image.mates.class_count(); ++k) {
    const std::span<const int> mates = image.mates.mates(k);
    const auto count = std::count_if(mates.begin(), mates.end(),
                                     [&](int sample) { return !image.mates.is_hole(sample); });
    statistics.largest_mate_class =
        std::max(statistics.largest_mate_class, static_cast<int>(count));
  }
  const Stretch stretch = measure_stretch(surface, triangles, samples.uv);
  statistics.stretch_l2 = stretch.l2;
  statistics.stretch_linf = stretch.linf;

  double worst = 0;
  Vec3d normal_before;
  std::array<int, 2> quad_before{-1, -1};
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    const Corners corners{samples.positions[a], samples.positions[b], samples.positions[c]};
    statistics.zero_area_triangles += has_no_area(corners) ? 1 : 0;
    const std::array<int, 2> quad = quad_of(triangles[i], image.size());
    const Vec3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    // The two triangles of a quad follow each other.
    statistics.folded_quads += quad == quad_before && dot(normal, normal_before) < 0 ? 1 : 0;
    normal_before = normal;
    quad_before = quad;
    const double largest =
        triangle_stretch(surface[i], samples.uv[a], samples.uv[b], samples.uv[c]).largest;
    if (surface[i].area <= 0 || largest <= worst) continue;
    worst = largest;
    statistics.worst_quad = quad;
  }
  return statistics;
}

}  // namespace weft
