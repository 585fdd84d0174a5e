#include "weft/mesh/distance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "weft/core/assert.h"
#include "weft/core/random.h"
#include "weft/core/thread_team.h"

namespace weft {
namespace {

Vec3d random_point(const TriangleMesh& mesh, int triangle, Random& random) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  // The square root makes the pair of weights uniform over the triangle.
  const double s = std::sqrt(random.uniform()), t = random.uniform();
  return (1 - s) * mesh.positions[a] + (s * (1 - t)) * mesh.positions[b] +
         (s * t) * mesh.positions[c];
}

/// Squared distances from samples to their closest points, each computed from its sample alone.
std::vector<double> squared_distances(const std::vector<Vec3d>& samples,
                                      const ClosestPointQuery& query,
                                      const DistanceOptions& options) {
  constexpr int block = 4096;  // samples between two reports of progress
  const int count = static_cast<int>(samples.size());
  std::vector<double> squared(samples.size());
  ThreadTeam team(options.threads);
  for (int start = 0; start < count; start += block) {
    update(options.progress, "measure", static_cast<double>(start) / count);
    team.run([&](Worker& worker) {
      const Range mine = worker.share(std::min(block, count - start));
      int hint = 0;
      for (int i = start + mine.first; i < start + mine.last; ++i) {
        const ClosestPoint found = query.closest(samples[i], hint);
        squared[i] = found.squared_distance;
        hint = found.triangle;
      }
    });
  }
  return squared;
}

void append_corners(const TriangleMesh& mesh, std::vector<Vec3d>& points) {
  std::vector<char> is_corner(mesh.positions.size());
  for (const auto& triangle : mesh.triangles)
    for (const int corner : triangle) is_corner[corner] = 1;
  for (std::size_t v = 0; v < is_corner.size(); ++v)
    if (is_corner[v]) points.push_back(mesh.positions[v]);
}

/// Distances from one surface to another: the mean over area samples, the maximum over every vertex
/// too, since tips have little area and may lie far off.
OneSidedDistance one_sided(const TriangleMesh& from, const ClosestPointQuery& to,
                           const DistanceOptions& options) {
  std::vector<Vec3d> points = sample_surface(from, options.samples, options.seed);
  append_corners(from, points);
  const std::vector<double> squared = squared_distances(points, to, options);
  double sum = 0;
  for (int i = 0; i < options.samples; ++i) sum += squared[i];
  return {std::sqrt(sum / options.samples),
          std::sqrt(*std::max_element(squared.begin(), squared.end()))};
}

}  // namespace

std::vector<Vec3d> sample_surface(const TriangleMesh& mesh, int count, std::uint64_t seed) {
  WEFT_ASSERT(!mesh.triangles.empty());
  std::vector<double> area_up_to(mesh.triangles.size());
  double total = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    total += 0.5 * length(cross(mesh.positions[b] - mesh.positions[a],
                                mesh.positions[c] - mesh.positions[a]));
    area_up_to[t] = total;
  }
  Random random(seed);
  std::vector<Vec3d> samples(count);
  std::size_t triangle = 0;
  for (int i = 0; i < count; ++i) {
    const double area = total * ((i + random.uniform()) / count);
    while (triangle + 1 < area_up_to.size() && area_up_to[triangle] <= area) ++triangle;
    samples[i] = random_point(mesh, static_cast<int>(triangle), random);
  }
  return samples;
}

SurfaceDistance surface_distance(const TriangleMesh& a, const TriangleMesh& b,
                                 const DistanceOptions& options) {
  return surface_distance(a, ClosestPointQuery(a), b, options);
}

SurfaceDistance surface_distance(const TriangleMesh& a, const ClosestPointQuery& near_a,
                                 const TriangleMesh& b, const DistanceOptions& options) {
  WEFT_ASSERT(options.samples > 0 && options.threads > 0);
  PartOfProgress first(options.progress, "measure", 0, 0.5);
  PartOfProgress second(options.progress, "measure", 0.5, 1);
  SurfaceDistance distance;
  distance.from_first =
      one_sided(a, ClosestPointQuery(b), {options.samples, options.seed, options.threads, &first});
  distance.from_second =
      one_sided(b, near_a, {options.samples, options.seed, options.threads, &second});
  distance.rms = std::max(distance.from_first.rms, distance.from_second.rms);
  distance.hausdorff = std::max(distance.from_first.largest, distance.from_second.largest);
  return distance;
}

}  // namespace weft
