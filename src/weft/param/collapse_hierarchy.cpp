#include "weft/param/collapse_hierarchy.h"

namespace weft {

CollapseHierarchy::CollapseHierarchy(const DiskMesh& disk)
    : triangles_(disk.triangles),
      valence_(disk.positions.size(), 0),
      present_(disk.triangles.size(), true),
      inner_(disk.positions.size(), true),
      border_(disk.positions.size(), false),
      stamp_(disk.positions.size(), 0),
      triangle_count_(static_cast<int>(disk.triangles.size())) {
  HalfEdges edges = half_edges(vertex_count(), triangles_);
  twin_ = std::move(edges.twin);
  outgoing_ = std::move(edges.outgoing);
  for (const int v : disk.border) {
    border_[v] = true;
    inner_[v] = false;
    ++valence_[v];  // no half-edge leaves along the border edge that arrives
  }
  for (int h = 0; h < 3 * triangle_count_; ++h) ++valence_[from(h)];
  for (int v = 0; v < vertex_count(); ++v)
    if (outgoing_[v] < 0) inner_[v] = false;
}

bool CollapseHierarchy::can_collapse(int half_edge) {
  const int target = to(half_edge);
  const int left = to(HalfEdges::next(half_edge));
  const int right = to(HalfEdges::next(twin_[half_edge]));
  ++round_;
  bool chord = false;
  around(from(half_edge), [&](int h) {
    const int v = to(h);
    stamp_[v] = round_;
    chord = chord || (border_[target] && border_[v] && v != target && v != left && v != right);
  });
  if (chord) return false;

  // Link condition: the two ends have no common neighbours except the apexes of the edge's
  // triangles.
  int common = 0;
  int h = outgoing_[target];
  if (twin_[h] < 0 && stamp_[to(h)] == round_) ++common;
  const int first = h;
  do {
    const int arriving = HalfEdges::previous(h);
    if (stamp_[from(arriving)] == round_) ++common;
    h = twin_[arriving];
  } while (h >= 0 && h != first);
  return common == 2;
}

void CollapseHierarchy::join(int half_edge, int other) {
  if (half_edge >= 0) twin_[half_edge] = other;
  if (other >= 0) twin_[other] = half_edge;
}

void CollapseHierarchy::collapse(int half_edge) {
  // The triangles (v, u, a) and (u, v, b) are removed; two edges at a become one, and two at b.
  const int back = twin_[half_edge];
  const int ua = HalfEdges::next(half_edge);
  const int av = HalfEdges::previous(half_edge);
  const int vb = HalfEdges::next(back);
  const int bu = HalfEdges::previous(back);
  const int v = from(half_edge);
  const int u = to(half_edge);
  const int a = from(av);
  const int b = from(bu);

  around(v, [&](int h) {
    if (h != half_edge && h != vb) set_start(h, u);
  });
  if (!border_[u] || outgoing_[u] == ua) outgoing_[u] = twin_[av];
  if (outgoing_[a] == av) outgoing_[a] = twin_[ua];
  if (outgoing_[b] == bu) outgoing_[b] = twin_[vb];
  join(twin_[av], twin_[ua]);
  join(twin_[vb], twin_[bu]);

  valence_[u] += valence_[v] - 4;
  --valence_[a];
  --valence_[b];
  inner_[v] = false;
  present_[half_edge / 3] = present_[back / 3] = false;
  triangle_count_ -= 2;
  collapsed_.push_back(half_edge);
}

int CollapseHierarchy::undo() {
  const int half_edge = collapsed_.back();
  collapsed_.pop_back();
  const int back = twin_[half_edge];
  const int ua = HalfEdges::next(half_edge);
  const int av = HalfEdges::previous(half_edge);
  const int vb = HalfEdges::next(back);
  const int bu = HalfEdges::previous(back);
  const int v = from(half_edge);
  const int u = to(half_edge);
  const int a = from(av);
  const int b = from(bu);
  for (const int h : {ua, av, vb, bu})
    if (twin_[h] >= 0) twin_[twin_[h]] = h;

  inner_[v] = true;
  present_[half_edge / 3] = present_[back / 3] = true;
  triangle_count_ += 2;
  ++valence_[a];
  ++valence_[b];
  around(v, [&](int h) { set_start(h, v); });
  valence_[u] -= valence_[v] - 4;
  if (!border_[u]) outgoing_[u] = back;
  if (twin_[ua] < 0) outgoing_[u] = ua;
  if (twin_[bu] < 0) outgoing_[b] = bu;
  return half_edge;
}

CoarseDisk coarse_disk(const CollapseHierarchy& mesh, const DiskMesh& fine) {
  CoarseDisk coarse;
  std::vector<bool> used(fine.positions.size(), false);
  for (const int v : fine.border) used[v] = true;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.is_inner(v)) used[v] = true;
  std::vector<int> renumbered(fine.positions.size(), -1);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!used[v]) continue;
    renumbered[v] = static_cast<int>(coarse.vertex.size());
    coarse.vertex.push_back(v);
    coarse.disk.positions.push_back(fine.positions[v]);
    coarse.disk.surface_vertex.push_back(fine.surface_vertex[v]);
  }
  for (int t = 0; t < static_cast<int>(mesh.triangles().size()); ++t) {
    if (!mesh.has_triangle(t)) continue;
    const auto& [a, b, c] = mesh.triangles()[t];
    coarse.disk.triangles.push_back({renumbered[a], renumbered[b], renumbered[c]});
  }
  for (const int v : fine.border) coarse.disk.border.push_back(renumbered[v]);
  return coarse;
}

}  // namespace weft
