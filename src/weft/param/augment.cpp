#include "weft/param/augment.h"

#include <limits>

#include "weft/param/border_layout.h"
#include "weft/param/chords.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/interior_solver.h"
#include "weft/param/proxy.h"
#include "weft/param/reweighting.h"
#include "weft/param/rotation.h"
#include "weft/param/stretch_newton.h"
#include "weft/param/weights.h"

namespace weft {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Verdict {
  double stretch = infinity;  ///< L2, after the Newton steps
  int worst_vertex = -1;  ///< of the mesh: where the area-averaged stretch before them is largest
};

int worst_vertex(const DiskGeometry& geometry, std::span<const Vec2d> uv, int vertex_count) {
  const std::vector<double> sigma = vertex_stretch(geometry.surface, geometry.disk.triangles, uv);
  std::vector<bool> candidate(uv.size(), true);
  for (const int v : geometry.disk.border) candidate[v] = false;
  int worst = -1;
  for (std::size_t v = 0; v < uv.size(); ++v) {
    if (!candidate[v] || geometry.disk.surface_vertex[v] >= vertex_count) continue;
    if (worst < 0 || sigma[v] > sigma[worst]) worst = static_cast<int>(v);
  }
  return worst < 0 ? -1 : geometry.disk.surface_vertex[worst];
}

/// Maps quickly: two steps of reweighting, for the first map alone would mislead (one nearly
/// collapsed triangle dominates its stretch); then three Newton steps, after which cuts compare as
/// they will in the end. The vertex to reach is that of the reweighted map, where the want of a cut
/// still shows.
Verdict judge(const TriangleMesh& mesh, const Cut& cut, int size, Progress* progress) {
  CutDisk opened = cut_open(mesh, cut);
  if (least_size(opened) > size) return {};
  constexpr int rotations = 4;
  const BorderLayout layout =
      lay_out_border(opened, {size, choose_rotation(opened, size, rotations)});
  split_at_corners(opened, layout);
  split_chords(opened.disk);

  std::vector<Vec2d> uv(opened.disk.positions.size());
  const std::vector<double> t = border_positions(opened, layout);
  for (std::size_t b = 0; b < t.size(); ++b) uv[opened.disk.border[b]] = border_point(size, t[b]);
  const DiskGeometry geometry(opened.disk);
  InteriorSolver solver(opened.disk, geometry.edges);
  std::vector<double> weights = symmetric_weights(opened.disk, geometry.edges, geometry.sides);
  PartOfProgress first(progress, "cut", 0, 0.5);
  PartOfProgress second(progress, "cut", 0.5, 1);
  ReweightingOptions options;
  options.iterations = 2;
  options.progress = &first;
  const bool valid = map_by_reweighting(geometry, solver, weights, uv, options);
  const int worst = worst_vertex(geometry, uv, static_cast<int>(mesh.positions.size()));
  const std::vector<BorderSlide> slides = border_slides(opened, layout, t);
  if (valid) minimise_by_newton(geometry, uv, {.steps = 3, .progress = &second, .slides = slides});
  return {valid ? geometry.stretch_l2(uv) : infinity, worst};
}

/// The vertices that the cut is to reach, in order, judged on a mesh of moderate size.
std::vector<int> find_targets(const TriangleMesh& mesh, Cut cut, const AugmentOptions& options) {
  constexpr double least_gain = 0.005;
  constexpr int patience = 2;
  std::vector<int> targets;
  std::size_t kept = 0;
  PartOfProgress start(options.progress, "cut", 0, 0);
  Verdict verdict = judge(mesh, cut, options.size, &start);
  double best = verdict.stretch;
  for (int round = 0, weak = 0; round < options.most_rounds && weak < patience; ++round) {
    PartOfProgress part(options.progress, "cut", static_cast<double>(round) / options.most_rounds,
                        (round + 1.0) / options.most_rounds);
    if (verdict.worst_vertex < 0) break;
    targets.push_back(verdict.worst_vertex);
    cut = extend_cut(mesh, cut, verdict.worst_vertex);
    verdict = judge(mesh, cut, options.size, &part);
    // As long as no map is valid at all, every cut is a gain.
    const bool gained = best == infinity || verdict.stretch < best * (1 - least_gain);
    weak = gained ? 0 : weak + 1;
    if (verdict.stretch < best) {
      best = verdict.stretch;
      kept = targets.size();
    }
  }
  targets.resize(kept);
  return targets;
}

}  // namespace

AugmentedCut augment_cut(const TriangleMesh& mesh, const Cut& cut, const AugmentOptions& options) {
  std::vector<int> targets;
  if (static_cast<int>(mesh.triangles.size()) > options.proxy_triangles) {
    const Proxy proxy = coarsen(mesh, cut, options.proxy_triangles);
    for (const int v : find_targets(proxy.mesh, proxy.cut, options))
      targets.push_back(proxy.source_vertex[v]);
  } else {
    targets = find_targets(mesh, cut, options);
  }

  AugmentedCut result{.cut = cut};
  for (const int target : targets) {
    Cut longer = extend_cut(mesh, result.cut, target);
    if (least_size(cut_open(mesh, longer)) > options.size) break;
    result.cut = std::move(longer);
    ++result.rounds;
  }
  update(options.progress, "cut", 1.0);
  return result;
}

}  // namespace weft
