#include "weft/param/collapse_passes.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Unit normal of a triangle times its shape quality, 4 sqrt(3) area / (sum of the squared sides):
/// 1 for equal sides, 0 for no area.
Vec3d facing(Vec3d a, Vec3d b, Vec3d c) {
  const double squares = squared_length(b - a) + squared_length(c - b) + squared_length(a - c);
  constexpr double two_root_three = 3.4641016151377544;
  return squares > 0 ? two_root_three / squares * cross(b - a, c - a) : Vec3d{};
}

/// Whether a collapse turns a triangle too far or makes it a sliver.
bool spoils_shape(const DiskMesh& disk, const CollapseHierarchy& mesh, int half_edge) {
  constexpr double min_cosine = 0.5;
  constexpr double min_quality = 0.2;
  const int u = mesh.to(half_edge);
  bool spoils = false;
  mesh.around(mesh.from(half_edge), [&](int h) {
    const int b = mesh.to(h);
    const int c = mesh.from(HalfEdges::previous(h));
    if (spoils || b == u || c == u) return;
    const auto& p = disk.positions;
    const Vec3d before = facing(p[mesh.from(h)], p[b], p[c]);
    const Vec3d after = facing(p[u], p[b], p[c]);
    const double worse = std::min(min_quality, 0.5 * length(before));
    spoils =
        length(after) < worse || dot(before, after) < min_cosine * length(before) * length(after);
  });
  return spoils;
}

struct Candidate {
  double cost;
  int half_edge;
  auto operator<=>(const Candidate&) const = default;
};

class Passes {
 public:
  Passes(CollapseHierarchy& mesh, const CollapseOrder& order, int triangles)
      : mesh_(mesh), order_(order), triangles_(triangles), resting_(mesh.vertex_count(), -1) {}

  /// Runs one pass with collapses of cost up to `max`. @return how many vertices were collapsed
  int run(double max);
  [[nodiscard]] double min_refused() const { return min_refused_; }
  [[nodiscard]] bool is_done() const { return mesh_.triangle_count() <= triangles_; }

 private:
  bool take_away(int vertex, double max);

  CollapseHierarchy& mesh_;
  const CollapseOrder& order_;
  int triangles_;
  std::vector<int> resting_;  ///< [V] the last pass in which a vertex is skipped
  std::vector<Candidate> candidates_;
  int pass_ = 0;
  double min_refused_ = HUGE_VAL;
};

int Passes::run(double max) {
  ++pass_;
  min_refused_ = HUGE_VAL;
  int count = 0;
  for (int v = 0; v < mesh_.vertex_count() && !is_done(); ++v)
    if (mesh_.is_inner(v) && resting_[v] != pass_ && take_away(v, max)) ++count;
  return count;
}

bool Passes::take_away(int vertex, double max) {
  candidates_.clear();
  mesh_.around(vertex, [&](int h) {
    const double cost = order_.cost(mesh_, h);
    if (cost <= max)
      candidates_.push_back({cost, h});
    else
      min_refused_ = std::min(min_refused_, cost);
  });
  std::sort(candidates_.begin(), candidates_.end());
  for (const auto& [cost, h] : candidates_) {
    if (!mesh_.can_collapse(h) || !order_.allows(mesh_, h)) continue;
    mesh_.around(vertex, [&](int side) { resting_[mesh_.to(side)] = pass_; });
    mesh_.collapse(h);
    return true;
  }
  return false;
}

}  // namespace

CollapseOrder shortest_first(const DiskMesh& disk) {
  constexpr int max_edges = 10;
  CollapseOrder order;
  order.cost = [&disk](const CollapseHierarchy& mesh, int h) {
    return squared_length(disk.positions[mesh.from(h)] - disk.positions[mesh.to(h)]);
  };
  order.allows = [&disk](const CollapseHierarchy& mesh, int h) {
    const int v = mesh.from(h);
    const int u = mesh.to(h);
    const bool too_many = mesh.is_inner(u) && mesh.valence(v) + mesh.valence(u) - 4 > max_edges;
    return !too_many && !spoils_shape(disk, mesh, h);
  };
  return order;
}

CollapseOrder min_valence_first() {
  CollapseOrder order;
  order.cost = [](const CollapseHierarchy& mesh, int h) {
    return static_cast<double>(mesh.valence(mesh.from(h)) + mesh.valence(mesh.to(h)) - 4);
  };
  order.allows = [](const CollapseHierarchy&, int) { return true; };
  return order;
}

void collapse_in_passes(CollapseHierarchy& mesh, const CollapseOrder& order,
                        const PassOptions& options) {
  Passes passes(mesh, order, options.triangles);
  double max = options.first_cost;
  while (!passes.is_done()) {
    const int before = mesh.triangle_count();
    const int gone = passes.run(max);
    if (gone == 0 && !(passes.min_refused() < HUGE_VAL)) return;
    if (gone > before / 40) continue;
    max = std::max(max * options.growth, gone == 0 ? passes.min_refused() : max);
  }
}

}  // namespace weft
