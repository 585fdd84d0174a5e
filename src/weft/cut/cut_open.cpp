#include <algorithm>
#include <array>
#include <climits>
#include <numeric>

#include <fmt/format.h>

#include "weft/cut/cut_graph.h"
#include "weft/cut/cut_surface.h"
#include "weft/cut/disk_mesh.h"
#include "weft/cut/open_to_disk.h"
#include "weft/error.h"

namespace weft {

namespace {

/// With fewer border vertices, two edges of the disk would have the same ends.
constexpr int min_border = 3;

/// Whether a path of the border begins at a vertex of it.
bool is_node(const CutGraph& graph, const FixedBorder& fixed, int vertex) {
  return graph.valence(vertex) != 2 ||
         std::binary_search(fixed.nodes.begin(), fixed.nodes.end(), vertex);
}

/// The open half-edges in border order, starting at a node if there is one.
std::vector<int> walk_border(const CutGraph& graph, const FixedBorder& fixed) {
  const CutSurface& surface = graph.surface();
  int start = -1;
  for (int h = 0; h < surface.half_edge_count(); ++h) {
    if (!graph.contains(h)) continue;
    if (start < 0) start = h;
    if (!is_node(graph, fixed, surface.from(h))) continue;
    start = h;
    break;
  }
  std::vector<int> border;
  if (start < 0) return border;
  int h = start;
  do {
    border.push_back(h);
    h = graph.next_open(h);
  } while (h != start);
  return border;
}

/// Numbers the disk vertices. Open edges divide the corners around a surface vertex into wedges;
/// each wedge is one disk vertex. The first wedge keeps the index of the surface vertex, further
/// ones follow after all surface vertices.
class WedgeNumbers {
 public:
  explicit WedgeNumbers(const CutGraph& graph)
      : graph_(graph), surface_(graph.surface()), corner_(surface_.half_edge_count(), -1) {
    const int vertices = surface_.vertex_count();
    std::vector<char> used(vertices, 0);
    for (int v = 0; v < vertices; ++v) surface_vertex_.push_back(v);
    for (int h = 0; h < surface_.half_edge_count(); ++h) {
      if (corner_[h] >= 0) continue;
      const int v = surface_.from(h);
      int name = v;
      if (used[v]) {
        name = static_cast<int>(surface_vertex_.size());
        surface_vertex_.push_back(v);
      }
      used[v] = 1;
      fill(h, name);
    }
  }
  /// [3F] disk vertex at the start of a half-edge, in its triangle.
  [[nodiscard]] const std::vector<int>& corners() const { return corner_; }
  [[nodiscard]] const std::vector<int>& surface_vertices() const { return surface_vertex_; }

 private:
  void fill(int h, int name) {
    for (int g = h; g >= 0 && corner_[g] < 0;) {
      corner_[g] = name;
      g = graph_.contains(g) ? -1 : HalfEdges::next(surface_.twin(g));
    }
    for (int g = h; g >= 0;) {
      const int arriving = HalfEdges::previous(g);
      g = graph_.contains(arriving) ? -1 : surface_.twin(arriving);
      if (g >= 0 && corner_[g] >= 0) return;
      if (g >= 0) corner_[g] = name;
    }
  }

  const CutGraph& graph_;
  const CutSurface& surface_;
  std::vector<int> corner_, surface_vertex_;
};

/// A connected surface is a disk when its Euler characteristic is 1: one border loop, no handle.
void check_disk(const CutGraph& graph, std::size_t disk_vertices) {
  const CutSurface& surface = graph.surface();
  int open = 0;
  for (int h = 0; h < surface.half_edge_count(); ++h) open += graph.contains(h) ? 1 : 0;
  const int edges = (surface.half_edge_count() + open) / 2;
  const int euler = static_cast<int>(disk_vertices) - edges + surface.triangle_count();
  const int pieces = graph.piece_count();
  if (pieces != 1 || euler != 1 || open == 0)
    throw TopologyError("cut",
                        fmt::format("the mesh opens to {} pieces with {} border edges and Euler "
                                    "characteristic {}",
                                    pieces, open, euler),
                        "one disk (1 piece, Euler characteristic 1) is wanted");
}

DiskMesh opened_mesh(const CutGraph& graph, const std::vector<int>& border) {
  const CutSurface& surface = graph.surface();
  const WedgeNumbers wedges(graph);
  check_disk(graph, wedges.surface_vertices().size());
  DiskMesh disk;
  disk.surface_vertex = wedges.surface_vertices();
  for (const int v : disk.surface_vertex) disk.positions.push_back(surface.mesh().positions[v]);
  for (int t = 0; t < surface.triangle_count(); ++t)
    disk.triangles.push_back(
        {wedges.corners()[3 * t], wedges.corners()[3 * t + 1], wedges.corners()[3 * t + 2]});
  disk.surface_triangle.resize(disk.triangles.size());
  std::iota(disk.surface_triangle.begin(), disk.surface_triangle.end(), 0);
  for (const int h : border) disk.border.push_back(wedges.corners()[h]);
  return disk;
}

/// [3F] the border loop of a border half-edge, -1 for interior ones.
std::vector<int> loops_of_half_edges(const CutSurface& surface) {
  std::vector<int> loop_of_vertex(surface.vertex_count(), -1);
  const auto loops = border_loops(surface.mesh().triangles, surface.edges());
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (const int v : loops[i]) loop_of_vertex[v] = static_cast<int>(i);
  std::vector<int> loop_of(surface.half_edge_count(), -1);
  for (int h = 0; h < surface.half_edge_count(); ++h)
    if (surface.twin(h) < 0) loop_of[h] = loop_of_vertex[surface.from(h)];
  return loop_of;
}

/// The curve that a path follows, by its first edge.
void set_curve(const FixedBorder& fixed, int from, int to, BorderPath& path) {
  const FixedBorder::Edge wanted{from, to, INT_MIN, false};
  const auto found = std::lower_bound(fixed.edges.begin(), fixed.edges.end(), wanted);
  if (found == fixed.edges.end() || found->from != from || found->to != to) return;
  path.curve = found->curve;
  path.forward = found->forward;
  if (!fixed.intervals.empty()) path.intervals = fixed.intervals[path.curve];
}

std::vector<BorderPath> divide(const CutGraph& graph, const std::vector<int>& border,
                               const FixedBorder& fixed) {
  const CutSurface& surface = graph.surface();
  const std::vector<int> loop_of = loops_of_half_edges(surface);
  std::vector<int> path_of(surface.half_edge_count(), -1);
  std::vector<BorderPath> paths;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const int from = surface.from(border[i]);
    if (i == 0 || is_node(graph, fixed, from)) {
      BorderPath& path = paths.emplace_back();
      path.first = static_cast<int>(i);
      path.border_loop = loop_of[border[i]];
      if (surface.twin(border[i]) < 0) set_curve(fixed, from, surface.to(border[i]), path);
    }
    ++paths.back().edges;
    path_of[border[i]] = static_cast<int>(paths.size()) - 1;
  }
  for (BorderPath& path : paths) {
    const int twin = surface.twin(border[path.first]);
    if (twin >= 0) path.mate = path_of[twin];
  }
  return paths;
}

}  // namespace

CutDisk cut_open(const TriangleMesh& mesh, const Cut& cut, const FixedBorder& fixed) {
  return cut_open(CutSurface(mesh), cut, fixed);
}

CutDisk cut_open(const CutSurface& surface, const Cut& cut, const FixedBorder& fixed) {
  const CutGraph graph(surface, cut);
  const std::vector<int> border = walk_border(graph, fixed);
  CutDisk opened;
  opened.disk = opened_mesh(graph, border);
  opened.paths = divide(graph, border, fixed);
  while (static_cast<int>(opened.disk.border.size()) < min_border)
    split_border_edge(opened, 0, 0.5);
  return opened;
}

Cut extend_cut(const TriangleMesh& mesh, const Cut& cut, int vertex) {
  return extend_cut(CutSurface(mesh), cut, vertex);
}

Cut extend_cut(const CutSurface& surface, const Cut& cut, int vertex) {
  CutGraph graph(surface, cut);
  const PathTree tree =
      search_paths(surface, std::array{vertex}, [&](int v) { return graph.valence(v) > 0; });
  if (tree.end < 0) return cut;
  for (const int h : path_to(surface, tree, tree.end)) graph.add(h);
  return graph.cut();
}

namespace {

double path_length(const DiskMesh& disk, const BorderPath& path) {
  const int size = static_cast<int>(disk.border.size());
  double total = 0;
  for (int j = 0; j < path.edges; ++j)
    total += length(disk.positions[disk.border[(path.first + j) % size]] -
                    disk.positions[disk.border[(path.first + j + 1) % size]]);
  return total;
}

}  // namespace

CutSummary summarise(const CutDisk& cut) {
  CutSummary summary;
  std::vector<int> nodes;
  const int count = static_cast<int>(cut.paths.size());
  for (int p = 0; p < count; ++p) {
    const BorderPath& path = cut.paths[p];
    nodes.push_back(cut.disk.surface_vertex[cut.disk.border[path.first]]);
    if (path.mate >= 0 && path.mate < p) continue;
    ++summary.paths;
    if (path.mate >= 0) summary.length += path_length(cut.disk, path);
  }
  std::sort(nodes.begin(), nodes.end());
  summary.nodes = static_cast<int>(std::unique(nodes.begin(), nodes.end()) - nodes.begin());
  return summary;
}

}  // namespace weft
