#include "weft/param/proxy.h"

#include <algorithm>

#include "weft/mesh/topology.h"
#include "weft/param/length_queue.h"

namespace weft {
namespace {

/// Replaces one value of a short list.
void replace(std::vector<int>& list, int from, int to) {
  std::replace(list.begin(), list.end(), from, to);
}
bool contains(const std::vector<int>& list, int value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

class Coarsener {
 public:
  Coarsener(const TriangleMesh& mesh, const Cut& cut);
  void run(int triangles);
  [[nodiscard]] Proxy result() const;

 private:
  void add_feature(int a, int b);
  void push(int a, int b);
  void push_all();
  template <class Visit>
  void for_each_around(int vertex, const Visit& visit) const;
  [[nodiscard]] bool has(int triangle, int vertex) const;
  int mark_neighbours(int vertex);
  [[nodiscard]] bool feature_allows(int from, int to) const;
  [[nodiscard]] bool topology_allows(int from, int to);
  [[nodiscard]] bool shape_allows(int from, int to) const;
  bool collapse(int from, int to);
  void move_triangles(int from, int to);

  const TriangleMesh& mesh_;
  std::vector<Triangle> triangles_;
  std::vector<char> triangle_alive_;
  std::vector<int> first_corner_;  ///< [V] head of the list of a vertex's corners 3 t + k; -1: none
  std::vector<int> next_corner_;   ///< [3F]; corners of dead triangles stay until the next merge
  std::vector<std::vector<int>> feature_;  ///< [V] neighbours along cut and border
  std::vector<int> mark_;                  ///< [V] the last round in which a vertex was marked
  int round_ = 0;
  LengthQueue queue_;
  int alive_ = 0;
};

Coarsener::Coarsener(const TriangleMesh& mesh, const Cut& cut)
    : mesh_(mesh),
      triangles_(mesh.triangles),
      triangle_alive_(mesh.triangles.size(), 1),
      first_corner_(mesh.positions.size(), -1),
      next_corner_(3 * mesh.triangles.size(), -1),
      feature_(mesh.positions.size()),
      mark_(mesh.positions.size(), 0),
      alive_(static_cast<int>(mesh.triangles.size())) {
  for (int c = 3 * alive_ - 1; c >= 0; --c) {
    int& first = first_corner_[from_vertex(mesh.triangles, c)];
    next_corner_[c] = first;
    first = c;
  }
  const HalfEdges edges = half_edges(static_cast<int>(mesh.positions.size()), mesh.triangles);
  for (int h = 0; h < static_cast<int>(edges.twin.size()); ++h)
    if (edges.twin[h] < 0)
      add_feature(from_vertex(mesh.triangles, h), to_vertex(mesh.triangles, h));
  for (const auto& [a, b] : cut.edges) add_feature(a, b);
}

void Coarsener::add_feature(int a, int b) {
  feature_[a].push_back(b);
  feature_[b].push_back(a);
}

void Coarsener::push(int a, int b) {
  queue_.push(squared_length(mesh_.positions[a] - mesh_.positions[b]),
              {std::min(a, b), std::max(a, b)});
}

void Coarsener::push_all() {
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (!triangle_alive_[t]) continue;
    // An interior edge occurs twice, once in each direction.
    for (int k = 0; k < 3; ++k) {
      const int a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
      if (a < b || contains(feature_[a], b)) push(a, b);
    }
  }
}

template <class Visit>
void Coarsener::for_each_around(int vertex, const Visit& visit) const {
  for (int c = first_corner_[vertex]; c >= 0; c = next_corner_[c])
    if (triangle_alive_[c / 3]) visit(c / 3);
}

bool Coarsener::has(int triangle, int vertex) const {
  const auto& [a, b, c] = triangles_[triangle];
  return a == vertex || b == vertex || c == vertex;
}

/// Marks a vertex and its neighbours. @return the mark
int Coarsener::mark_neighbours(int vertex) {
  ++round_;
  for_each_around(vertex, [&](int t) {
    for (const int v : triangles_[t]) mark_[v] = round_;
  });
  return round_;
}

bool Coarsener::feature_allows(int from, int to) const {
  const std::vector<int>& line = feature_[from];
  if (line.empty()) return true;
  if (line.size() != 2 || !contains(line, to)) return false;
  const int other = line[0] == to ? line[1] : line[0];
  return other != to && !contains(feature_[to], other);
}

/// Link condition: the two vertices have no common neighbours except the apexes of their edge's
/// triangles.
bool Coarsener::topology_allows(int from, int to) {
  int shared = 0;
  for_each_around(from, [&](int t) { shared += has(t, to) ? 1 : 0; });
  if (shared == 0) return false;
  const int of_from = mark_neighbours(from);
  const int common_mark = ++round_;
  int common = 0;
  for_each_around(to, [&](int t) {
    for (const int v : triangles_[t]) {
      if (v == from || v == to || mark_[v] != of_from) continue;
      mark_[v] = common_mark;
      ++common;
    }
  });
  return shared == common;
}

bool Coarsener::shape_allows(int from, int to) const {
  bool allowed = true;
  const auto& p = mesh_.positions;
  for_each_around(from, [&](int t) {
    if (!allowed || has(t, to)) return;
    const auto normal = [&](const Triangle& corners) {
      return cross(p[corners[1]] - p[corners[0]], p[corners[2]] - p[corners[0]]);
    };
    Triangle moved = triangles_[t];
    const Vec3d before = normal(moved);
    std::replace(moved.begin(), moved.end(), from, to);
    const Vec3d after = normal(moved);
    const double along = dot(before, after);
    // The cosine between the normals before and after must be at least 0.2.
    allowed = along >= 0 && along * along >= 0.04 * squared_length(before) * squared_length(after);
  });
  return allowed;
}

/// Moves the triangles of one vertex to another and removes those that have both.
void Coarsener::move_triangles(int from, int to) {
  for_each_around(from, [&](int t) {
    if (has(t, to)) {
      triangle_alive_[t] = 0;
      --alive_;
    } else {
      std::replace(triangles_[t].begin(), triangles_[t].end(), from, to);
    }
  });
  int merged = -1;
  for (const int list : {first_corner_[from], first_corner_[to]})
    for (int c = list; c >= 0;) {
      const int next = next_corner_[c];
      if (triangle_alive_[c / 3]) {
        next_corner_[c] = merged;
        merged = c;
      }
      c = next;
    }
  first_corner_[to] = merged;
  first_corner_[from] = -1;
}

bool Coarsener::collapse(int from, int to) {
  if (!feature_allows(from, to) || !topology_allows(from, to) || !shape_allows(from, to))
    return false;
  if (!feature_[from].empty()) {
    const int other = feature_[from][0] == to ? feature_[from][1] : feature_[from][0];
    replace(feature_[other], from, to);
    replace(feature_[to], from, other);
  }
  const int old = mark_neighbours(to);
  move_triangles(from, to);
  for_each_around(to, [&](int t) {
    for (const int v : triangles_[t]) {
      if (mark_[v] == old) continue;
      mark_[v] = old;
      push(to, v);
    }
  });
  return true;
}

void Coarsener::run(int triangles) {
  // A collapse that was rejected may be allowed once its neighbourhood has changed.
  for (int before = alive_ + 1; alive_ > triangles && alive_ < before;) {
    before = alive_;
    push_all();
    while (alive_ > triangles && !queue_.empty()) {
      const auto [a, b] = queue_.pop();
      if (first_corner_[a] < 0 || first_corner_[b] < 0) continue;
      if (!collapse(b, a)) collapse(a, b);
    }
  }
}

Proxy Coarsener::result() const {
  Proxy proxy;
  std::vector<char> used(mesh_.positions.size(), 0);
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (const int v : triangles_[t]) used[v] |= triangle_alive_[t];
  std::vector<int> renumbered(mesh_.positions.size(), -1);
  for (int v = 0; v < static_cast<int>(used.size()); ++v) {
    if (!used[v]) continue;
    renumbered[v] = static_cast<int>(proxy.source_vertex.size());
    proxy.source_vertex.push_back(v);
    proxy.mesh.positions.push_back(mesh_.positions[v]);
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    if (triangle_alive_[t])
      proxy.mesh.triangles.push_back({renumbered[a], renumbered[b], renumbered[c]});
  }
  const HalfEdges edges =
      half_edges(static_cast<int>(proxy.mesh.positions.size()), proxy.mesh.triangles);
  for (int h = 0; h < static_cast<int>(edges.twin.size()); ++h) {
    const int a = from_vertex(proxy.mesh.triangles, h);
    const int b = to_vertex(proxy.mesh.triangles, h);
    if (edges.twin[h] > h && contains(feature_[proxy.source_vertex[a]], proxy.source_vertex[b]))
      proxy.cut.edges.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(proxy.cut.edges.begin(), proxy.cut.edges.end());
  return proxy;
}

}  // namespace

Proxy coarsen(const TriangleMesh& mesh, const Cut& cut, int triangles) {
  Coarsener coarsener(mesh, cut);
  coarsener.run(triangles);
  return coarsener.result();
}

}  // namespace weft
