#include "weft/mesh/partition.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "weft/mesh/topology.h"

namespace weft {
namespace {

/// Rounds of Lloyd's method; it mostly ends sooner.
constexpr int max_rounds = 10;
/// What a triangle that faces against its region costs, over one that faces as it does.
constexpr double turned_cost = 3;

Vec2f uv_at(const TriangleMesh& mesh, int triangle, int vertex) {
  const Triangle& t = mesh.triangles[triangle];
  for (int k = 0; k < 3; ++k)
    if (t[k] == vertex) return mesh.corner_uv[triangle][k];
  return {};
}

bool same_uv(const TriangleMesh& mesh, int a, int b, int vertex) {
  const Vec2f p = uv_at(mesh, a, vertex), q = uv_at(mesh, b, vertex);
  return p.x == q.x && p.y == q.y;
}

/// The triangles of a surface, joined across edges that are not parted.
class Triangles {
 public:
  Triangles(const TriangleMesh& mesh, const EdgeUses& edges, const std::vector<bool>& parted)
      : neighbour_(3 * mesh.triangles.size(), -1) {
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3d p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
      centre_.push_back((1.0 / 3) * (p + q + r));
      area_.push_back(0.5 * cross(q - p, r - p));
    }
    for (int e = 0; e < edges.edge_count(); ++e) {
      if (parted[e] || edges.of(e).size() != 2) continue;
      const int a = edges.of(e)[0], b = edges.of(e)[1];
      neighbour_[a] = b / 3;
      neighbour_[b] = a / 3;
    }
  }
  [[nodiscard]] int count() const { return static_cast<int>(centre_.size()); }
  /// Across the edge from corner k, or -1.
  [[nodiscard]] int neighbour(int triangle, int k) const { return neighbour_[3 * triangle + k]; }
  [[nodiscard]] double distance(int a, int b) const { return length(centre_[b] - centre_[a]); }
  [[nodiscard]] Vec3d area(int triangle) const { return area_[triangle]; }

 private:
  std::vector<int> neighbour_;
  std::vector<Vec3d> centre_, area_;
};

/// Paths over triangles, from several at once, the shortest first.
class ShortestPaths {
 public:
  explicit ShortestPaths(const Triangles& triangles)
      : triangles_(triangles), distance_(triangles.count(), HUGE_VAL) {}
  void start(int triangle, double distance) {
    if (!(distance < distance_[triangle])) return;
    distance_[triangle] = distance;
    queue_.emplace(distance, triangle);
  }
  /// Goes on to all that becomes nearer. @param step  its cost, from a triangle to the next
  /// @param relax  told of each step that was the shortest so far
  template <class Step, class Relax>
  void run(const Step& step, const Relax& relax) {
    while (!queue_.empty()) {
      const auto [distance, at] = queue_.top();
      queue_.pop();
      if (distance > distance_[at]) continue;
      for (int k = 0; k < 3; ++k) {
        const int next = triangles_.neighbour(at, k);
        if (next < 0) continue;
        const double there = distance + step(at, next);
        if (!(there < distance_[next])) continue;
        relax(at, next);
        start(next, there);
      }
    }
  }
  [[nodiscard]] double distance(int triangle) const { return distance_[triangle]; }

 private:
  using Entry = std::pair<double, int>;
  const Triangles& triangles_;
  std::vector<double> distance_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

/// A triangle of every connected part, then again and again the one farthest from all others, of
/// those that may be divided.
std::vector<int> first_seeds(const Triangles& triangles, const PartChoice& choice) {
  std::vector<int> seeds;
  ShortestPaths paths(triangles);
  const auto step = [&](int a, int b) { return triangles.distance(a, b); };
  const auto add = [&](int seed) {
    seeds.push_back(seed);
    paths.start(seed, 0);
    paths.run(step, [](int, int) {});
  };
  for (int t = 0; t < triangles.count(); ++t)
    if (paths.distance(t) == HUGE_VAL) add(t);
  while (static_cast<int>(seeds.size()) < choice.regions) {
    int farthest = seeds[0];  // at no distance
    for (int t = 0; t < triangles.count(); ++t)
      if (paths.distance(t) > paths.distance(farthest) &&
          (choice.divisible.empty() || choice.divisible[t]))
        farthest = t;
    if (!(paths.distance(farthest) > 0)) break;
    add(farthest);
  }
  return seeds;
}

/// The region of every triangle, grown from the seeds.
/// @param normals  [regions] of unit length or 0
std::vector<int> grow(const Triangles& triangles, const std::vector<int>& seeds,
                      const std::vector<Vec3d>& normals) {
  std::vector<int> region(static_cast<std::size_t>(triangles.count()), -1);
  ShortestPaths paths(triangles);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    region[seeds[i]] = static_cast<int>(i);
    paths.start(seeds[i], 0);
  }
  const auto step = [&](int a, int b) {
    const double facing = dot(normals[region[a]], normalized(triangles.area(b)));
    return triangles.distance(a, b) * (1 + 0.5 * (turned_cost - 1) * (1 - facing));
  };
  paths.run(step, [&](int a, int b) { region[b] = region[a]; });
  return region;
}

std::vector<Vec3d> normals_of(const Triangles& triangles, const std::vector<int>& region,
                              std::size_t regions) {
  std::vector<Vec3d> normals(regions);
  for (int t = 0; t < triangles.count(); ++t) normals[region[t]] += triangles.area(t);
  for (Vec3d& normal : normals) normal = normalized(normal);
  return normals;
}

/// Of every region the triangle farthest from its border.
std::vector<int> middles_of(const Triangles& triangles, const std::vector<int>& region,
                            const std::vector<int>& seeds) {
  ShortestPaths paths(triangles);
  for (int t = 0; t < triangles.count(); ++t)
    for (int k = 0; k < 3; ++k)
      if (const int next = triangles.neighbour(t, k); next < 0 || region[next] != region[t])
        paths.start(t, 0);
  paths.run(
      [&](int a, int b) { return region[a] == region[b] ? triangles.distance(a, b) : HUGE_VAL; },
      [](int, int) {});
  std::vector<int> middles = seeds;
  for (int t = 0; t < triangles.count(); ++t) {
    const double here = paths.distance(t);
    if (here < HUGE_VAL && here > paths.distance(middles[region[t]])) middles[region[t]] = t;
  }
  return middles;
}

/// Takes teeth off borders: a triangle between two of another region joins that.
void smooth_borders(const Triangles& triangles, std::vector<int>& region) {
  constexpr int passes = 4;
  for (int pass = 0; pass < passes; ++pass)
    for (int t = 0; t < triangles.count(); ++t)
      for (int k = 0; k < 3; ++k) {
        const int a = triangles.neighbour(t, k), b = triangles.neighbour(t, (k + 1) % 3);
        if (a >= 0 && b >= 0 && region[a] == region[b]) region[t] = region[a];
      }
}

}  // namespace

int part_at_texture_seams(const TriangleMesh& mesh, const EdgeUses& edges,
                          std::vector<bool>& parted) {
  int count = 0;
  for (int e = 0; e < edges.edge_count(); ++e) {
    if (parted[e] || edges.of(e).size() != 2) continue;
    const int h = edges.of(e)[0], a = h / 3, b = edges.of(e)[1] / 3;
    if (same_uv(mesh, a, b, from_vertex(mesh.triangles, h)) &&
        same_uv(mesh, a, b, to_vertex(mesh.triangles, h)))
      continue;
    parted[e] = true;
    ++count;
  }
  return count;
}

int part_in_regions(const TriangleMesh& mesh, const EdgeUses& edges, const PartChoice& choice,
                    std::vector<bool>& parted) {
  const Triangles triangles(mesh, edges, parted);
  std::vector<int> seeds = first_seeds(triangles, choice);
  std::vector<int> region = grow(triangles, seeds, std::vector<Vec3d>(seeds.size()));
  for (int round = 0; round < max_rounds; ++round) {
    std::vector<int> middles = middles_of(triangles, region, seeds);
    if (middles == seeds) break;
    seeds = std::move(middles);
    region = grow(triangles, seeds, normals_of(triangles, region, seeds.size()));
  }
  smooth_borders(triangles, region);
  for (int e = 0; e < edges.edge_count(); ++e)
    if (edges.of(e).size() == 2 && region[edges.of(e)[0] / 3] != region[edges.of(e)[1] / 3])
      parted[e] = true;
  std::sort(region.begin(), region.end());
  return static_cast<int>(std::unique(region.begin(), region.end()) - region.begin());
}

}  // namespace weft
