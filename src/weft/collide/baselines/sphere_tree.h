#pragma once

#include <span>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/cell_tiles.h"
#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/broad_phase/unfolded_windows.h"

namespace weft {

/// Bounding sphere hierarchy over an image [benes05]: spheres around the four vertices of every
/// cell, then around four spheres each, bottom-up. Here they hold the vertices over a whole step.
class SphereLevels {
 public:
  explicit SphereLevels(int cells);
  /// Fits all levels. To be called by every worker; ends with a barrier.
  void fit(const MovingSurface& surface, Worker& worker);

  [[nodiscard]] const std::vector<int>& sides() const { return sides_; }
  [[nodiscard]] Node root() const { return {static_cast<int>(sides_.size()) - 1, 0, 0}; }
  struct Sphere {
    Vec3f centre;
    float radius = -1;
    /// Whether the sphere is around nothing, or positions that are not finite: it meets nothing.
    [[nodiscard]] bool empty() const { return radius < 0; }
  };
  [[nodiscard]] const Sphere& at(const Node& node) const {
    const auto level = static_cast<std::size_t>(node.level);
    return levels_[level][static_cast<std::size_t>(node.row) * sides_[level] + node.col];
  }

 private:
  void fit_cell(const MovingSurface& surface, int cell);
  void fit_node(const Node& node);

  std::vector<int> sides_;
  std::vector<std::vector<Sphere>> levels_;  // [side * side] each, finest first
};

/// The broad phase of GI-COLLIDE [benes05]: two images are tested by descending into one and the
/// other in turn.
class SphereTreePairs final : public BroadPhase {
 public:
  /// @param grids  of all surfaces, kept by the caller; the first `cloths` are cloths
  SphereTreePairs(std::span<const SurfaceGrid* const> grids, std::size_t cloths);

  void refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) override;
  void find(int surface_a, int surface_b, float reach, ThreadTeam& team,
            std::vector<CandidateTile>& out) override;
  void find_self(int surface, float reach, float slack, ThreadTeam& team,
                 std::vector<CandidateTile>& out) override;

 private:
  struct NodePair {
    Node a, b;
  };
  struct Search {
    const SphereLevels *a, *b;
    float reach = 0;
    bool same = false;
  };
  /// Descends from a pair until `stop(pair)` holds or both are cells, and emits the pairs that may
  /// meet.
  template <class Stop, class Emit>
  static void descend(const Search& search, const NodePair& pair, const Stop& stop,
                      const Emit& emit);
  void gather_tasks(const Search& search);

  std::vector<SphereLevels> levels_;    // one a surface
  std::vector<UnfoldedWindows> folds_;  // one a cloth
  std::vector<int> fitted_to_;          // names of the surfaces' motions
  std::vector<NodePair> tasks_;
  std::vector<MovingSurface> surfaces_;
  SharedPairs shared_;
};

}  // namespace weft
