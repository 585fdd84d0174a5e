#include "weft/mesh/shapes/remesh.h"

#include <algorithm>
#include <utility>

#include "weft/mesh/shapes/editable_mesh.h"
#include "weft/mesh_statistics.h"

namespace weft {
namespace {

constexpr double too_long = 4.0 / 3, too_short = 4.0 / 5;  // of the wanted length
constexpr double fair_quality = 0.3;

class Remesher {
 public:
  Remesher(TriangleMesh mesh, const RemeshOptions& options)
      : mesh_(std::move(mesh)), options_(options) {}

  TriangleMesh run() {
    for (int v = 0; v < mesh_.vertex_count(); ++v)
      mesh_.move(v, projected(mesh_.position(v), is_border(v)));
    for (int pass = 0; pass < options_.passes; ++pass) {
      split_long_edges();
      merge_short_edges();
      flip_edges();
      relax_vertices();
    }
    flip_edges();
    return mesh_.compact();
  }

 private:
  [[nodiscard]] bool is_border(int v) const { return mesh_.border_neighbours(v).has_value(); }
  [[nodiscard]] Vec3d projected(Vec3d p, bool to_border) const {
    return to_border ? project_to_curve(options_.surface, options_.cut, p)
                     : project_to_surface(options_.surface, p);
  }
  [[nodiscard]] Vec3d middle(int a, int b) const {
    return 0.5 * (mesh_.position(a) + mesh_.position(b));
  }
  /// Length over the wanted length.
  [[nodiscard]] double relative_length(Vec3d p, Vec3d q) const {
    return length(p - q) / options_.edge_length(0.5 * (p + q));
  }
  [[nodiscard]] double relative_length(int a, int b) const {
    return relative_length(mesh_.position(a), mesh_.position(b));
  }

  template <class Visit>
  void for_each_edge(const Visit& visit);
  void split_long_edges();
  void merge_short_edges();
  void flip_edges();
  void relax_vertices();
  void merge(int a, int b);
  bool merge_at(int a, int b, Vec3d to);
  [[nodiscard]] bool faces_outwards(Vec3d a, Vec3d b, Vec3d c, int replaced) const;
  [[nodiscard]] bool may_move(int vertex, Vec3d to, int ignored, double min_quality) const;
  [[nodiscard]] Vec3d centre_of_neighbourhood(int vertex) const;

  EditableMesh mesh_;
  const RemeshOptions& options_;
};

/// Visits every edge once, including edges that the visit adds.
template <class Visit>
void Remesher::for_each_edge(const Visit& visit) {
  for (int slot = 0; slot < mesh_.slot_count(); ++slot)
    for (int k = 0; k < 3 && mesh_.is_alive(slot); ++k) {
      const int a = mesh_.triangle(slot)[k], b = mesh_.triangle(slot)[(k + 1) % 3];
      if (a < b || mesh_.triangles_at_edge(a, b) == 1) visit(a, b);
    }
}

void Remesher::split_long_edges() {
  for_each_edge([&](int a, int b) {
    if (relative_length(a, b) <= too_long) return;
    const Vec3d half_way = middle(a, b);
    const Vec3d at = projected(half_way, mesh_.triangles_at_edge(a, b) == 1);
    // A point that the projection moves far would leave both halves as long as before.
    const bool is_near = length(at - half_way) < 0.8 * length(mesh_.position(a) - half_way);
    mesh_.split(a, b, is_near ? at : half_way);
  });
}

void Remesher::merge_short_edges() {
  for_each_edge([&](int a, int b) {
    if (relative_length(a, b) < too_short) merge(a, b);
  });
}

/// True when the normal of a new triangle agrees with that of the one it replaces, or else with the
/// field's gradient, since the normals of tiny triangles may be meaningless.
bool Remesher::faces_outwards(Vec3d a, Vec3d b, Vec3d c, int replaced) const {
  constexpr double min_cosine = 0.5;
  const Vec3d normal = normalized(cross(b - a, c - a));
  if (dot(normal, normalized(mesh_.area_normal(replaced))) > min_cosine) return true;
  const Vec3d outward = gradient(options_.surface, (1.0 / 3) * (a + b + c));
  return dot(normal, normalized(outward)) > min_cosine;
}

/// True when a move of a vertex flips no triangle around it and lowers no quality to below
/// `min_quality`; triangles that hold `ignored` do not count.
bool Remesher::may_move(int vertex, Vec3d to, int ignored, double min_quality) const {
  for (const int slot : mesh_.around(vertex)) {
    const Triangle& t = mesh_.triangle(slot);
    if (std::find(t.begin(), t.end(), ignored) != t.end()) continue;
    const auto place = [&](int v) { return v == vertex ? to : mesh_.position(v); };
    const Vec3d a = place(t[0]), b = place(t[1]), c = place(t[2]);
    if (!faces_outwards(a, b, c, slot)) return false;
    const double quality = triangle_quality(a, b, c);
    if (quality < min_quality && quality < mesh_.quality(slot)) return false;
  }
  return true;
}

/// Merges b into a at a position, unless that would spoil the edges and triangles around them.
bool Remesher::merge_at(int a, int b, Vec3d to) {
  // A tiny edge is merged even if its neighbours become long or, being tiny too, slivers for a
  // while.
  constexpr double tiny = 0.4;
  const bool is_tiny = relative_length(a, b) < tiny;
  for (const int v : {a, b})
    for (const int w : mesh_.neighbours(v))
      if (!is_tiny && w != a && w != b && relative_length(to, mesh_.position(w)) > too_long)
        return false;
  const double min_quality = is_tiny ? 0 : fair_quality;
  if (!may_move(a, to, b, min_quality) || !may_move(b, to, a, min_quality)) return false;
  mesh_.collapse(a, b, to);
  return true;
}

void Remesher::merge(int a, int b) {
  if (!mesh_.can_collapse(a, b)) return;
  const bool border_a = is_border(a), border_b = is_border(b);
  if (border_a == border_b && merge_at(a, b, projected(middle(a, b), border_a))) return;
  // A border vertex must not leave its border.
  if ((border_a || !border_b) && merge_at(a, b, mesh_.position(a))) return;
  if (border_b || !border_a) merge_at(b, a, mesh_.position(b));
}

void Remesher::flip_edges() {
  for_each_edge([&](int a, int b) { mesh_.flip_if_better(a, b); });
}

/// The centroid of the triangles around a vertex, weighted so that their sizes follow the wanted
/// length.
Vec3d Remesher::centre_of_neighbourhood(int vertex) const {
  Vec3d sum;
  double weights = 0;
  for (const int slot : mesh_.around(vertex)) {
    const auto& [a, b, c] = mesh_.triangle(slot);
    const Vec3d centre = (1.0 / 3) * (mesh_.position(a) + mesh_.position(b) + mesh_.position(c));
    const double weight = length(mesh_.area_normal(slot)) * options_.edge_length(centre);
    sum += weight * centre;
    weights += weight;
  }
  return (1 / weights) * sum;
}

void Remesher::relax_vertices() {
  for (int v = 0; v < mesh_.vertex_count(); ++v) {
    if (mesh_.around(v).empty()) continue;
    const auto along_border = mesh_.border_neighbours(v);
    const Vec3d target =
        along_border ? middle((*along_border)[0], (*along_border)[1]) : centre_of_neighbourhood(v);
    const Vec3d to = projected(target, along_border.has_value());
    if (may_move(v, to, -1, fair_quality)) mesh_.move(v, to);
  }
}

}  // namespace

TriangleMesh remesh(TriangleMesh mesh, const RemeshOptions& options) {
  return Remesher(std::move(mesh), options).run();
}

}  // namespace weft
