#include "weft/cut/open_to_disk.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "weft/cut/cut_surface.h"
#include "weft/cut/seed_cut.h"
#include "weft/cut/straighten.h"
#include "weft/error.h"

namespace weft {
namespace {

/// A further seed shortens the cut by a few percent at best, so large meshes, where it is slow, get
/// fewer.
constexpr int max_seeds = 4;
constexpr int triangles_for_all_seeds = 80000;

int seed_count(int triangles) {
  return std::clamp(triangles_for_all_seeds / triangles, 1, max_seeds);
}

Cut open_sphere(const CutSurface& surface, int seed_triangle) {
  CutGraph graph(surface);
  for (const int h : far_path(surface, surface.mesh().triangles[seed_triangle][0])) graph.add(h);
  return graph.cut();
}

CutGraph open_from(const CutGraph& held, int seed_triangle, bool straightened) {
  CutGraph graph = cut_from_seed(held, seed_triangle);
  if (straightened) straighten(graph);
  return graph;
}

/// The shortest of the cuts from a few seeds; the first of equal ones.
Cut shortest_cut(const CutGraph& held, bool straightened) {
  const CutSurface& surface = held.surface();
  std::optional<Cut> best;
  double best_length = 0;
  for (const int seed : spread_triangles(surface, 0, seed_count(surface.triangle_count()))) {
    const CutGraph graph = open_from(held, seed, straightened);
    const double length = graph.length();
    if (best && length >= best_length) continue;
    best = graph.cut();
    best_length = length;
  }
  return *best;
}

void check_seed(int seed_triangle, int triangles) {
  if (seed_triangle < -1 || seed_triangle >= triangles)
    throw TopologyError("seed triangle", fmt::format("{}", seed_triangle),
                        fmt::format("0 to {}, or -1 to choose", triangles - 1));
}

}  // namespace

Cut complete_cut(const CutGraph& held, const CutOptions& options) {
  check_seed(options.seed_triangle, held.surface().triangle_count());
  if (options.seed_triangle < 0) return shortest_cut(held, options.straighten);
  return open_from(held, options.seed_triangle, options.straighten).cut();
}

Cut open_to_disk(const TriangleMesh& mesh, const CutOptions& options) {
  return open_to_disk(CutSurface(mesh), options);
}

Cut open_to_disk(const CutSurface& surface, const CutOptions& options) {
  check_seed(options.seed_triangle, surface.triangle_count());
  const TopologyCounts counts = count_topology(surface.mesh().triangles, surface.edges());
  if (counts.genus == 0 && counts.boundaries == 1) return {};
  if (counts.genus == 0 && counts.boundaries == 0)
    return open_sphere(surface, options.seed_triangle < 0 ? 0 : options.seed_triangle);
  return complete_cut(CutGraph(surface), options);
}

}  // namespace weft
