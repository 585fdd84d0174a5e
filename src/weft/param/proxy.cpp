#include "weft/param/proxy.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "weft/mesh/one_ring.h"
#include "weft/mesh/topology.h"

namespace weft {
namespace {

/// Replaces one value of a short list.
void replace(std::vector<int>& list, int from, int to) {
  std::replace(list.begin(), list.end(), from, to);
}
void erase(std::vector<int>& list, int value) { std::erase(list, value); }
bool contains(const std::vector<int>& list, int value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

class Coarsener {
 public:
  Coarsener(const TriangleMesh& mesh, const Cut& cut);
  void run(int triangles);
  [[nodiscard]] Proxy result() const;

 private:
  using Candidate = std::tuple<double, int, int>;  ///< squared length, ends

  void add_feature(int a, int b);
  void push(int a, int b);
  [[nodiscard]] std::vector<int> neighbours(int vertex) const;
  [[nodiscard]] bool feature_allows(int from, int to) const;
  [[nodiscard]] bool topology_allows(int from, int to) const;
  [[nodiscard]] bool shape_allows(int from, int to) const;
  bool collapse(int from, int to);

  const TriangleMesh& mesh_;
  std::vector<Triangle> triangles_;
  std::vector<bool> triangle_alive_, vertex_alive_;
  std::vector<std::vector<int>> around_;   ///< triangles of a vertex
  std::vector<std::vector<int>> feature_;  ///< neighbours along cut and border
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
  int alive_ = 0;
};

Coarsener::Coarsener(const TriangleMesh& mesh, const Cut& cut)
    : mesh_(mesh),
      triangles_(mesh.triangles),
      triangle_alive_(mesh.triangles.size(), true),
      vertex_alive_(mesh.positions.size(), true),
      around_(mesh.positions.size()),
      feature_(mesh.positions.size()),
      alive_(static_cast<int>(mesh.triangles.size())) {
  const HalfEdges edges = half_edges(static_cast<int>(mesh.positions.size()), mesh.triangles);
  for (int h = 0; h < static_cast<int>(edges.twin.size()); ++h) {
    const int a = from_vertex(mesh.triangles, h);
    const int b = to_vertex(mesh.triangles, h);
    around_[a].push_back(h / 3);
    if (edges.twin[h] < h) push(a, b);
    if (edges.twin[h] < 0) add_feature(a, b);
  }
  for (const auto& [a, b] : cut.edges) add_feature(a, b);
}

void Coarsener::add_feature(int a, int b) {
  feature_[a].push_back(b);
  feature_[b].push_back(a);
}

void Coarsener::push(int a, int b) {
  queue_.emplace(squared_length(mesh_.positions[a] - mesh_.positions[b]), std::min(a, b),
                 std::max(a, b));
}

std::vector<int> Coarsener::neighbours(int vertex) const {
  return one_ring(triangles_, around_[vertex], vertex);
}

bool Coarsener::feature_allows(int from, int to) const {
  const std::vector<int>& line = feature_[from];
  if (line.empty()) return true;
  if (line.size() != 2 || !contains(line, to)) return false;
  const int other = line[0] == to ? line[1] : line[0];
  return other != to && !contains(feature_[to], other);
}

bool Coarsener::topology_allows(int from, int to) const {
  const std::vector<int> a = neighbours(from);
  const std::vector<int> b = neighbours(to);
  std::vector<int> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  const auto shared = std::count_if(around_[from].begin(), around_[from].end(), [&](int t) {
    return std::find(triangles_[t].begin(), triangles_[t].end(), to) != triangles_[t].end();
  });
  return shared > 0 && shared == static_cast<std::ptrdiff_t>(common.size());
}

bool Coarsener::shape_allows(int from, int to) const {
  for (const int t : around_[from]) {
    Triangle moved = triangles_[t];
    if (std::find(moved.begin(), moved.end(), to) != moved.end()) continue;
    const auto normal = [&](const Triangle& corners) {
      const auto& p = mesh_.positions;
      return cross(p[corners[1]] - p[corners[0]], p[corners[2]] - p[corners[0]]);
    };
    const Vec3d before = normal(triangles_[t]);
    std::replace(moved.begin(), moved.end(), from, to);
    const Vec3d after = normal(moved);
    if (dot(before, after) < 0.2 * length(before) * length(after)) return false;
  }
  return true;
}

bool Coarsener::collapse(int from, int to) {
  if (!feature_allows(from, to) || !topology_allows(from, to) || !shape_allows(from, to))
    return false;
  for (const int t : around_[from]) {
    Triangle& corners = triangles_[t];
    if (std::find(corners.begin(), corners.end(), to) == corners.end()) {
      std::replace(corners.begin(), corners.end(), from, to);
      around_[to].push_back(t);
      continue;
    }
    triangle_alive_[t] = false;
    --alive_;
    for (const int v : corners)
      if (v != from) erase(around_[v], t);
  }
  if (!feature_[from].empty()) {
    const int other = feature_[from][0] == to ? feature_[from][1] : feature_[from][0];
    replace(feature_[other], from, to);
    replace(feature_[to], from, other);
  }
  around_[from].clear();
  vertex_alive_[from] = false;
  for (const int v : neighbours(to)) push(to, v);
  return true;
}

void Coarsener::run(int triangles) {
  while (alive_ > triangles && !queue_.empty()) {
    const auto [key, a, b] = queue_.top();
    queue_.pop();
    if (!vertex_alive_[a] || !vertex_alive_[b]) continue;
    if (!collapse(b, a)) collapse(a, b);
  }
}

Proxy Coarsener::result() const {
  Proxy proxy;
  std::vector<int> renumbered(mesh_.positions.size(), -1);
  for (int v = 0; v < static_cast<int>(vertex_alive_.size()); ++v) {
    if (!vertex_alive_[v] || around_[v].empty()) continue;
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
