#include "weft/param/augment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "weft/cut/cut_graph.h"
#include "weft/cut/cut_surface.h"
#include "weft/param/proxy.h"
#include "weft/param/rotation.h"
#include "weft/param/trial_map.h"

namespace weft {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Trial map of a cut at the best of four rotations; one of infinite energy where the size is too
/// small for the cut.
TrialMap evaluate_cut(const TriangleMesh& mesh, const Cut& cut, const TrialOptions& options) {
  const CutDisk opened = cut_open(mesh, cut);
  if (!has_room(options.size, opened)) return {};
  return try_chart(opened, options);
}

/// Vertices to extend the cut to, each once: that of largest stretch before the Newton steps, and
/// those farthest from the cut, by distance alone and by distance times functions of the remaining
/// stretch. Where no trial map was valid its stretch says nothing, as that of a long tube whose far
/// end has collapsed, and the distance alone counts.
std::vector<int> candidates(const TriangleMesh& mesh, const Cut& cut, const TrialMap& trial) {
  const CutSurface surface(mesh);
  const CutGraph graph(surface, cut);
  std::vector<int> sources;
  for (int v = 0; v < surface.vertex_count(); ++v)
    if (graph.valence(v) > 0) sources.push_back(v);
  std::vector<int> found;
  const auto add = [&](int v) {
    if (v >= 0 && std::find(found.begin(), found.end(), v) == found.end()) found.push_back(v);
  };
  add(trial.worst_vertex);
  if (sources.empty()) return found;
  const PathTree tree = paths_from(surface, sources);
  const bool is_valid = !trial.stretch_at.empty();
  const auto largest = [&](const auto& weight) {
    int best = -1;
    double max = 0;
    for (int v = 0; v < surface.vertex_count(); ++v) {
      const double stretch = is_valid ? trial.stretch_at[v] : 1;
      if (stretch <= 0 || !(tree.distance[v] < HUGE_VAL)) continue;
      const double value = weight(stretch) * tree.distance[v];
      if (value <= max) continue;
      max = value;
      best = v;
    }
    return best;
  };
  add(largest([](double) { return 1.0; }));
  if (!is_valid) return found;
  add(largest([](double s) { return s; }));
  add(largest([](double s) { return s * s; }));
  add(largest([](double s) { return s - 1; }));
  return found;
}

/// A cut, the vertices it was extended to in order, and its trial map.
struct Plan {
  Cut cut;
  std::vector<int> targets;
  TrialMap trial;
};

/// The best cut that is one path longer; without targets where there is no candidate.
Plan lengthen(const TriangleMesh& mesh, const Plan& plan, const AugmentOptions& options) {
  Plan best;
  const std::vector<int> goals = candidates(mesh, plan.cut, plan.trial);
  const double count = static_cast<double>(goals.size());
  for (std::size_t k = 0; k < goals.size(); ++k) {
    PartOfProgress part(options.progress, "cut", static_cast<double>(k) / count,
                        (static_cast<double>(k) + 1) / count);
    Plan next{extend_cut(mesh, plan.cut, goals[k]), plan.targets, {}};
    next.targets.push_back(goals[k]);
    next.trial = evaluate_cut(mesh, next.cut, {options.size, options.threads, &part});
    if (k == 0 || next.trial.energy < best.trial.energy) best = std::move(next);
  }
  return best;
}

/// The best cut found by extending it round by round.
Plan plan_cut(const TriangleMesh& mesh, const Cut& cut, const AugmentOptions& options) {
  constexpr double min_gain = 0.01;
  PartOfProgress start(options.progress, "cut", 0, 0);
  Plan plan{cut, {}, evaluate_cut(mesh, cut, {options.size, options.threads, &start})};
  Plan best = plan;
  for (int round = 0; round < options.max_rounds; ++round) {
    PartOfProgress part(options.progress, "cut", static_cast<double>(round) / options.max_rounds,
                        (round + 1.0) / options.max_rounds);
    AugmentOptions inner = options;
    inner.progress = &part;
    plan = lengthen(mesh, plan, inner);
    if (plan.targets.empty()) break;
    // While no map is valid, every longer cut counts as a gain.
    const bool gained =
        best.trial.energy == infinity || plan.trial.energy < best.trial.energy * (1 - min_gain);
    if (plan.trial.energy < best.trial.energy) best = plan;
    if (!gained) break;
  }
  return best;
}

}  // namespace

AugmentedCut augment_cut(const TriangleMesh& mesh, const Cut& cut, const AugmentOptions& options) {
  return augment_cut(CutSurface(mesh), cut, options);
}

AugmentedCut augment_cut(const CutSurface& surface, const Cut& cut, const AugmentOptions& options) {
  const TriangleMesh& mesh = surface.mesh();
  std::vector<int> targets;
  if (static_cast<int>(mesh.triangles.size()) > options.proxy_triangles) {
    const Proxy proxy = coarsen(mesh, cut, options.proxy_triangles);
    for (const int v : plan_cut(proxy.mesh, proxy.cut, options).targets)
      targets.push_back(proxy.source_vertex[v]);
  } else {
    targets = plan_cut(mesh, cut, options).targets;
  }

  AugmentedCut result{.cut = cut};
  for (const int target : targets) {
    Cut longer = extend_cut(surface, result.cut, target);
    if (!has_room(options.size, cut_open(surface, longer))) break;
    result.cut = std::move(longer);
    ++result.rounds;
  }
  update(options.progress, "cut", 1.0);
  return result;
}

}  // namespace weft
