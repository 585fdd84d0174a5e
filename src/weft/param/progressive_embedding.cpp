#include "weft/param/progressive_embedding.h"

#include <algorithm>
#include <vector>

#include "weft/param/collapse_passes.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/local_newton.h"
#include "weft/param/vertex_star.h"

namespace weft {

namespace {

class Reinsertion {
 public:
  Reinsertion(CollapseHierarchy& mesh, std::span<Vec2d> uv, const ReinsertionOptions& options);
  bool run();

 private:
  void renew_around(int vertex);
  bool bring_one_back();
  bool place(int vertex);
  void relax();
  void reserve(int half_edge, int circles);
  [[nodiscard]] std::vector<int> neighbourhood(int half_edge, int circles) const;

  CollapseHierarchy& mesh_;
  std::span<Vec2d> uv_;
  const ReinsertionOptions& options_;
  std::vector<StarTriangle> triangles_;
  VertexMover mover_;
  std::vector<Vec2d> ring_;
};

Reinsertion::Reinsertion(CollapseHierarchy& mesh, std::span<Vec2d> uv,
                         const ReinsertionOptions& options)
    : mesh_(mesh),
      uv_(uv),
      options_(options),
      triangles_(mesh.triangles().size()),
      mover_(mesh, triangles_, uv, options.threads) {
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    if (mesh_.has_triangle(static_cast<int>(t)))
      triangles_[t] = options_.triangle(mesh.triangles()[t]);
}

void Reinsertion::renew_around(int vertex) {
  mesh_.around(vertex,
               [&](int h) { triangles_[h / 3] = options_.triangle(mesh_.triangles()[h / 3]); });
}

bool Reinsertion::place(int vertex) {
  ring_.clear();
  Vec2d sum{};
  mesh_.around(vertex, [&](int h) {
    ring_.push_back(uv_[mesh_.to(h)]);
    sum = sum + ring_.back();
  });
  const Vec2d middle = 1.0 / static_cast<double>(ring_.size()) * sum;
  const std::optional<Vec2d> found = sees_all(ring_, middle) ? middle : kernel_point(ring_);
  if (found) uv_[vertex] = *found;
  return found.has_value();
}

/// The inner vertices in the first `circles` + 1 rings around the start of a half-edge, without
/// that vertex.
std::vector<int> Reinsertion::neighbourhood(int half_edge, int circles) const {
  std::vector<int> found;
  const int centre = mesh_.from(half_edge);
  const auto add = [&](int v) {
    if (mesh_.is_inner(v) && v != centre && std::find(found.begin(), found.end(), v) == found.end())
      found.push_back(v);
  };
  mesh_.around(centre, [&](int h) { add(mesh_.to(h)); });
  std::size_t done = 0;
  for (int circle = 0; circle < circles; ++circle)
    for (const std::size_t end = found.size(); done < end; ++done)
      mesh_.around(found[done], [&](int h) { add(mesh_.to(h)); });
  return found;
}

void Reinsertion::reserve(int half_edge, int circles) {
  constexpr int rounds = 8;
  const std::vector<int> near = neighbourhood(half_edge, circles);
  mesh_.collapse(half_edge);
  const auto renew = [&](int v) { renew_around(v); };
  std::for_each(near.begin(), near.end(), renew);
  for (int round = 0; round < rounds; ++round)
    for (const int v : near)
      if (!mover_.centre(v)) mover_.improve(v);
  mesh_.undo();
  renew_around(mesh_.from(half_edge));
}

bool Reinsertion::bring_one_back() {
  constexpr int max_circles = 12;
  const int half_edge = mesh_.undo();
  const int vertex = mesh_.from(half_edge);
  renew_around(vertex);
  for (int circles = 0; !place(vertex); ++circles) {
    if (circles == max_circles) {
      mesh_.collapse(half_edge);
      return false;
    }
    reserve(half_edge, circles);
  }
  mover_.improve(vertex);
  return true;
}

void Reinsertion::relax() {
  if (mesh_.triangle_count() > options_.many)
    return mover_.sweep_restless(2 * options_.sweeps, options_.freedoms);
  mover_.sweep(options_.sweeps, options_.freedoms);
}

bool Reinsertion::run() {
  const int whole = static_cast<int>(triangles_.size());
  do {
    const int count = mesh_.triangle_count();
    update(options_.progress, "map", static_cast<double>(count) / whole);
    const double wanted = std::max(count * options_.growth, count + 8.0);
    while (mesh_.depth() > 0 && mesh_.triangle_count() < wanted)
      if (!bring_one_back()) return false;
    relax();
  } while (mesh_.depth() > 0);
  return true;
}

}  // namespace

bool bring_back(CollapseHierarchy& mesh, std::span<Vec2d> uv, const ReinsertionOptions& options) {
  return Reinsertion(mesh, uv, options).run();
}

bool embed_progressively(const DiskMesh& disk, std::span<Vec2d> uv, Progress* progress) {
  constexpr StarTriangle equal_sides{{1, 0.5, 1, 0.4330127018922193}};
  CollapseHierarchy mesh(disk);
  collapse_in_passes(mesh, min_valence_first(), {.triangles = 0, .first_cost = 6, .growth = 1.25});

  Box3d box;
  for (const int v : disk.border) box.add({uv[v].x, uv[v].y, 0});
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.is_inner(v)) uv[v] = {box.centre().x, box.centre().y};
  ReinsertionOptions options;
  options.triangle = [&](const Triangle&) { return equal_sides; };
  options.progress = progress;
  return bring_back(mesh, uv, options) && is_valid_map(disk.triangles, uv);
}

}  // namespace weft
