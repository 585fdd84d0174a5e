#include "weft/mesh/shapes/editable_mesh.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "weft/core/assert.h"
#include "weft/mesh/topology.h"
#include "weft/mesh_statistics.h"

namespace weft {
namespace {

constexpr Triangle no_triangle{-1, -1, -1};

bool holds(const Triangle& t, int vertex) {
  return std::find(t.begin(), t.end(), vertex) != t.end();
}

Triangle with_vertex_replaced(Triangle t, int old, int by) {
  std::replace(t.begin(), t.end(), old, by);
  return t;
}

}  // namespace

EditableMesh::EditableMesh(TriangleMesh mesh)
    : positions_(std::move(mesh.positions)),
      triangles_(std::move(mesh.triangles)),
      around_(positions_.size()) {
  for (int slot = 0; slot < slot_count(); ++slot)
    for (const int v : triangles_[slot]) around_[v].push_back(slot);
}

std::vector<int> EditableMesh::neighbours(int vertex) const {
  return one_ring(triangles_, around_[vertex], vertex);
}

std::optional<std::array<int, 2>> EditableMesh::border_neighbours(int vertex) const {
  // Inside, every neighbour is in two triangles around the vertex, and so falls out here; on the
  // border two are in one only.
  int left = 0;
  for (const int slot : around_[vertex])
    for (const int v : triangles_[slot])
      if (v != vertex) left ^= v;
  if (left == 0) return std::nullopt;
  std::vector<int> found;
  for (const int v : neighbours(vertex))
    if (triangles_at_edge(vertex, v) == 1) found.push_back(v);
  WEFT_ASSERT(found.size() == 2);
  return std::array{found[0], found[1]};
}

int EditableMesh::triangles_at_edge(int a, int b) const {
  return static_cast<int>(std::count_if(around_[a].begin(), around_[a].end(),
                                        [&](int slot) { return holds(triangles_[slot], b); }));
}

Vec3d EditableMesh::normal_of(const Triangle& t) const {
  return cross(positions_[t[1]] - positions_[t[0]], positions_[t[2]] - positions_[t[0]]);
}

Vec3d EditableMesh::area_normal(int slot) const { return normal_of(triangles_[slot]); }

double EditableMesh::quality(int slot) const {
  const auto& [a, b, c] = triangles_[slot];
  return triangle_quality(positions_[a], positions_[b], positions_[c]);
}

int EditableMesh::slot_with_directed_edge(int a, int b) const {
  for (const int slot : around_[a]) {
    const Triangle& t = triangles_[slot];
    for (int k = 0; k < 3; ++k)
      if (t[k] == a && t[(k + 1) % 3] == b) return slot;
  }
  return -1;
}

int EditableMesh::opposite(int slot, int a, int b) const {
  for (const int v : triangles_[slot])
    if (v != a && v != b) return v;
  return -1;
}

void EditableMesh::remove(int slot) {
  for (const int v : triangles_[slot]) std::erase(around_[v], slot);
  triangles_[slot] = no_triangle;
}

void EditableMesh::replace(int slot, const Triangle& by) {
  remove(slot);
  triangles_[slot] = by;
  for (const int v : by) around_[v].push_back(slot);
}

void EditableMesh::add(const Triangle& triangle) {
  for (const int v : triangle) around_[v].push_back(slot_count());
  triangles_.push_back(triangle);
}

void EditableMesh::split(int a, int b, Vec3d at) {
  const int middle = vertex_count();
  positions_.push_back(at);
  around_.emplace_back();
  for (const int slot : {slot_with_directed_edge(a, b), slot_with_directed_edge(b, a)}) {
    if (slot < 0) continue;
    const Triangle old = triangles_[slot];
    replace(slot, with_vertex_replaced(old, b, middle));
    add(with_vertex_replaced(old, a, middle));
  }
}

bool EditableMesh::can_collapse(int a, int b) const {
  const int shared = triangles_at_edge(a, b);
  if (shared == 0) return false;
  // An inner edge between two border vertices would pinch the surface.
  if (shared == 2 && border_neighbours(a) && border_neighbours(b)) return false;
  const std::vector<int> of_a = neighbours(a), of_b = neighbours(b);
  std::vector<int> common;
  std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                        std::back_inserter(common));
  // Common neighbours other than those across the edge form loops that would vanish with it; so
  // would a lone triangle or tetrahedron.
  const std::size_t min_neighbours = shared == 2 ? 8 : 5;
  return static_cast<int>(common.size()) == shared && of_a.size() + of_b.size() >= min_neighbours;
}

void EditableMesh::collapse(int a, int b, Vec3d to) {
  const std::vector<int> slots = around_[b];
  for (const int slot : slots) {
    const Triangle old = triangles_[slot];
    if (holds(old, a)) {
      remove(slot);
    } else {
      replace(slot, with_vertex_replaced(old, b, a));
    }
  }
  positions_[a] = to;
}

bool EditableMesh::flip_if_better(int a, int b) {
  const int left = slot_with_directed_edge(a, b), right = slot_with_directed_edge(b, a);
  if (left < 0 || right < 0) return false;
  const int c = opposite(left, a, b), d = opposite(right, a, b);
  if (c == d || triangles_at_edge(c, d) > 0) return false;
  const Triangle first{a, d, c}, second{d, b, c};
  const auto quality_of = [&](const Triangle& t) {
    return triangle_quality(positions_[t[0]], positions_[t[1]], positions_[t[2]]);
  };
  const double before = std::min(quality(left), quality(right));
  if (std::min(quality_of(first), quality_of(second)) <= before + 1e-6) return false;
  // The normals of both new triangles must agree with the mean normal of the old ones.
  const Vec3d facing = normalized(area_normal(left) + area_normal(right));
  constexpr double min_cosine = 0.5;
  for (const Triangle& t : {first, second})
    if (dot(normalized(normal_of(t)), facing) < min_cosine) return false;
  replace(left, first);
  replace(right, second);
  return true;
}

TriangleMesh EditableMesh::compact() const {
  TriangleMesh mesh;
  std::vector<int> new_index(positions_.size(), -1);
  for (int v = 0; v < vertex_count(); ++v) {
    if (around_[v].empty()) continue;
    new_index[v] = static_cast<int>(mesh.positions.size());
    mesh.positions.push_back(positions_[v]);
  }
  for (const auto& [a, b, c] : triangles_)
    if (a >= 0) mesh.triangles.push_back({new_index[a], new_index[b], new_index[c]});
  return mesh;
}

}  // namespace weft
