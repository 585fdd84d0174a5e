#include <array>

#include "weft/cut/cut_graph.h"
#include "weft/cut/open_to_disk.h"
#include "weft/cut/shortest_paths.h"

namespace weft {

Cut extend_cut(const TriangleMesh& mesh, const Cut& cut, int vertex) {
  const CutSurface surface(mesh);
  CutGraph graph(surface, cut);
  const PathTree tree =
      search_paths(surface, std::array{vertex}, [&](int v) { return graph.valence(v) > 0; });
  if (tree.end < 0) return cut;
  for (const int h : path_to(surface, tree, tree.end)) graph.add(h);
  return graph.cut();
}

}  // namespace weft
