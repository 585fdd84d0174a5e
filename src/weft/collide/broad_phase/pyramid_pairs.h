#pragma once

#include <optional>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/broad_phase/path_boxes.h"
#include "weft/collide/broad_phase/unfolded_windows.h"

namespace weft {

/// Broad phase by the mip pyramids of the images as bounding hierarchies: boxes at both ends of the
/// step, certainly unfolded windows for a cloth with itself, slabs for bodies. All indices are
/// implicit; fitting takes O(N).
class PyramidPairs final : public BroadPhase {
 public:
  /// @param grids  of all surfaces, kept by the caller; the first `cloths` are cloths
  PyramidPairs(std::span<const SurfaceGrid* const> grids, std::size_t cloths);

  void refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) override;
  void find(int surface_a, int surface_b, float reach, ThreadTeam& team,
            std::vector<CandidatePair>& out) override;
  void find_self(int surface, float reach, float slack, ThreadTeam& team,
                 std::vector<CandidatePair>& out) override;
  [[nodiscard]] const PathBoxLevels* boxes(int surface) const override {
    return &levels_[static_cast<std::size_t>(surface)].boxes;
  }

 private:
  struct Levels {
    PathBoxLevels boxes;
    std::optional<UnfoldedWindows> folds;  // of cloths
    SlabLevels slabs;                      // of bodies
    int fitted_to = 0;                     // name of the motion
  };
  struct NodePair {
    Node a, b;
  };
  /// A pair of nodes with its path boxes, so that no search looks them up twice.
  struct PlacedPair {
    NodePair nodes;
    PathBox a, b;
  };
  /// Parameters of one search.
  struct Search {
    const CollideKernels* kernels;
    int a = 0, b = 0;
    float reach = 0;
  };

  [[nodiscard]] bool apart_by_slab(const Search& search, const PlacedPair& pair) const;
  [[nodiscard]] Extent along_slab(const Search& search, const Planes3& at, const Node& node,
                                  const Slab& slab) const;
  /// Descends from a near pair until `stop(pair)` holds and emits the pairs that may meet.
  template <class Stop, class Emit>
  void descend(const Search& search, const PlacedPair& pair, const Stop& stop,
               const Emit& emit) const;
  template <class Stop, class Emit>
  void descend_self(const Search& search, const NodePair& pair, const Stop& stop,
                    const Emit& emit) const;
  template <class Descend>
  void share_out(const Search& search, int tasks, ThreadTeam& team, std::vector<CandidatePair>& out,
                 const Descend& descend);

  std::size_t cloths_;
  std::vector<Levels> levels_;  // one a surface
  std::vector<MovingSurface> surfaces_;
  std::vector<PlacedPair> tasks_;  // of two surfaces
  std::vector<NodePair> self_tasks_;
  SharedPairs shared_;
};

}  // namespace weft
