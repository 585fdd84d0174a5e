#include "weft/mesh/distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "weft/core/assert.h"
#include "weft/core/random.h"
#include "weft/core/thread_team.h"
#include "weft/mesh/box_tree.h"

namespace weft {
namespace {

Vec3d closest_on_segment(Vec3d p, Vec3d a, Vec3d b) {
  const Vec3d edge = b - a;
  const double squared = squared_length(edge);
  const double t = squared > 0 ? std::clamp(dot(p - a, edge) / squared, 0.0, 1.0) : 0.0;
  return a + t * edge;
}

double squared_distance_to_box(Vec3d p, const Box3d& box) {
  return squared_length(max(max(box.lower - p, p - box.upper), Vec3d{}));
}

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

/// Distances from one surface to another: the means over area samples, the maximum over every
/// vertex too, since tips have little area and may lie far off.
OneSidedDistance one_sided(const TriangleMesh& from, const ClosestPointQuery& to,
                           const DistanceOptions& options) {
  std::vector<Vec3d> points = sample_surface(from, options.samples, options.seed);
  append_corners(from, points);
  const std::vector<double> squared = squared_distances(points, to, options);
  double sum = 0, sum_of_squares = 0;
  for (int i = 0; i < options.samples; ++i) {
    sum += std::sqrt(squared[i]);
    sum_of_squares += squared[i];
  }
  return {sum / options.samples, std::sqrt(sum_of_squares / options.samples),
          std::sqrt(*std::max_element(squared.begin(), squared.end()))};
}

}  // namespace

Vec3d closest_on_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d normal = cross(b - a, c - a);
  const double wa = dot(normal, cross(b - p, c - p)), wb = dot(normal, cross(c - p, a - p)),
               wc = dot(normal, cross(a - p, b - p));
  const double sum = wa + wb + wc;
  // A convex combination stays on the triangle, also where a sliver's normal is mostly rounding.
  if (wa >= 0 && wb >= 0 && wc >= 0 && sum > 0)
    return (wa / sum) * a + (wb / sum) * b + (wc / sum) * c;
  const std::array candidates{closest_on_segment(p, a, b), closest_on_segment(p, b, c),
                              closest_on_segment(p, c, a)};
  return *std::min_element(candidates.begin(), candidates.end(), [&](Vec3d x, Vec3d y) {
    return squared_length(p - x) < squared_length(p - y);
  });
}

struct ClosestPointQuery::Tree {
  BoxTree boxes;
  std::vector<int> place_of;     ///< from triangle to place in the tree
  std::vector<Corners> corners;  ///< by place

  explicit Tree(const std::vector<Corners>& triangles);
  void try_place(Vec3d point, int place, ClosestPoint& best) const;
  void search(Vec3d point, ClosestPoint& best) const;
};

ClosestPointQuery::Tree::Tree(const std::vector<Corners>& triangles)
    : boxes(triangles), place_of(triangles.size()) {
  WEFT_ASSERT(!triangles.empty());
  corners.reserve(triangles.size());
  for (int place = 0; place < static_cast<int>(triangles.size()); ++place) {
    corners.push_back(triangles[boxes.triangle_at[place]]);
    place_of[boxes.triangle_at[place]] = place;
  }
}

void ClosestPointQuery::Tree::try_place(Vec3d point, int place, ClosestPoint& best) const {
  const auto& [a, b, c] = corners[place];
  const Vec3d position = closest_on_triangle(point, a, b, c);
  const double squared = squared_length(point - position);
  const int triangle = boxes.triangle_at[place];
  // Of triangles equally far the first one wins: the result depends on neither tree nor hint.
  if (squared < best.squared_distance ||
      (squared == best.squared_distance && triangle < best.triangle))
    best = {position, triangle, squared};
}

void ClosestPointQuery::Tree::search(Vec3d point, ClosestPoint& best) const {
  struct Visit {
    int node;
    double squared;
  };
  std::array<Visit, 64> stack;  // the tree halves its runs: depth <= log2(2^31) + 1
  int depth = 0;
  stack[depth++] = {0, squared_distance_to_box(point, boxes.nodes[0].box)};
  while (depth > 0) {
    const Visit visit = stack[--depth];
    if (visit.squared > best.squared_distance) continue;
    const BoxTree::Node& node = boxes.nodes[visit.node];
    if (node.right < 0) {
      for (int place = node.first; place < node.last; ++place) try_place(point, place, best);
      continue;
    }
    const Visit left{visit.node + 1,
                     squared_distance_to_box(point, boxes.nodes[visit.node + 1].box)};
    const Visit right{node.right, squared_distance_to_box(point, boxes.nodes[node.right].box)};
    const bool left_first = left.squared <= right.squared;
    stack[depth++] = left_first ? right : left;
    stack[depth++] = left_first ? left : right;
  }
}

ClosestPointQuery::ClosestPointQuery(const TriangleMesh& mesh)
    : tree_(std::make_unique<Tree>(corners_of(mesh))) {}
ClosestPointQuery::ClosestPointQuery(ClosestPointQuery&&) noexcept = default;
ClosestPointQuery& ClosestPointQuery::operator=(ClosestPointQuery&&) noexcept = default;
ClosestPointQuery::~ClosestPointQuery() = default;

ClosestPoint ClosestPointQuery::closest(Vec3d point, int hint) const {
  ClosestPoint best;
  tree_->try_place(point, tree_->place_of[hint], best);
  tree_->search(point, best);
  return best;
}

bool ClosestPointQuery::any_within(Vec3d point, double distance,
                                   const std::function<bool(int triangle)>& accept) const {
  const double squared = distance * distance;
  const BoxTree& boxes = tree_->boxes;
  std::vector<int> stack{0};
  while (!stack.empty()) {
    const int at = stack.back();
    stack.pop_back();
    const BoxTree::Node& node = boxes.nodes[at];
    if (squared_distance_to_box(point, node.box) > squared) continue;
    if (node.right >= 0) {
      stack.insert(stack.end(), {node.right, at + 1});
      continue;
    }
    for (int place = node.first; place < node.last; ++place) {
      const auto& [a, b, c] = tree_->corners[place];
      if (squared_length(point - closest_on_triangle(point, a, b, c)) <= squared &&
          accept(boxes.triangle_at[place]))
        return true;
    }
  }
  return false;
}

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
