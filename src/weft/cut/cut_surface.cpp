#include "weft/cut/cut_surface.h"

#include <algorithm>
#include <array>

namespace weft {

CutSurface::CutSurface(const TriangleMesh& mesh)
    : mesh_(mesh), edges_(half_edges(vertex_count(), mesh.triangles)), length_(half_edge_count()) {
  for (int h = 0; h < half_edge_count(); ++h)
    length_[h] = weft::length(mesh.positions[from(h)] - mesh.positions[to(h)]);
}

PathTree paths_from(const CutSurface& surface, std::span<const int> sources) {
  return search_paths(surface, sources, [](int) { return false; });
}

std::vector<int> path_to(const CutSurface& surface, const PathTree& tree, int vertex) {
  std::vector<int> path;
  for (int v = vertex; tree.arrival[v] >= 0;) {
    path.push_back(tree.arrival[v]);
    v = surface.other_end(path.back(), v);
  }
  return path;
}

std::vector<int> far_path(const CutSurface& surface, int start) {
  std::vector<int> best;
  double best_distance = 0;
  for (int from = start;;) {
    const PathTree tree = paths_from(surface, std::array{from});
    const auto far = std::max_element(tree.distance.begin(), tree.distance.end());
    if (*far <= best_distance) return best;
    best_distance = *far;
    from = static_cast<int>(far - tree.distance.begin());
    best = path_to(surface, tree, from);
  }
}

}  // namespace weft
