#pragma once

#include "weft/collide/pairs/cell_pairs.h"
#include "weft/collide/pairs/extent_levels.h"
#include "weft/collide/pairs/shared_pairs.h"
#include "weft/collide/pairs/slab_levels.h"

namespace weft {

/// The mip pyramids of the images as bounding hierarchies: boxes swept over the step, extents of
/// edges for a cloth with itself, slabs for bodies. All indices are implicit; fitting takes O(N).
class PyramidPairs final : public BroadPhase {
 public:
  /// @param grids  of all surfaces, kept by the caller; the first `cloths` are cloths
  PyramidPairs(std::span<const SurfaceGrid* const> grids, std::size_t cloths);

  void refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) override;
  void find(int surface_a, int surface_b, float reach, ThreadTeam& team,
            std::vector<CellPair>& out) override;
  void find_self(int surface, float reach, float slack, ThreadTeam& team,
                 std::vector<CellPair>& out) override;

 private:
  struct Levels {
    ExtentLevels boxes, row_edges, column_edges;  // edges: of cloths
    Grid<float> flat_windows;                     // of cloths, 2 x 2 cells: 1 where unfolded
    float windows_slack = -1;                     // for which; negative: for none
    SlabLevels slabs;                             // of bodies
    bool fitted = false;                          // of bodies that stand still
  };
  struct NodePair {
    Node a, b;
  };
  /// What one search is about.
  struct Search {
    int a = 0, b = 0;
    float reach = 0, slack = 0;
  };

  [[nodiscard]] bool apart(const Search& search, const NodePair& pair) const;
  [[nodiscard]] bool apart_by_slab(const Search& search, const NodePair& pair) const;
  [[nodiscard]] bool unfolded(const Search& search, const NodePair& pair) const;
  void find_flat_windows(int surface, float slack, ThreadTeam& team);
  [[nodiscard]] bool flat_window(int surface, int row, int col) const;
  /// The same for two cells side by side, by windows that hold both.
  [[nodiscard]] bool neighbours_unfolded(int surface, const Node& a, const Node& b) const;
  /// Splits a pair until `stop(pair)` holds, and hands out what may meet.
  template <class Stop, class Emit>
  void descend(const Search& search, const NodePair& pair, const Stop& stop,
               const Emit& emit) const;
  template <class Stop, class Emit>
  void descend_self(const Search& search, const NodePair& pair, const Stop& stop,
                    const Emit& emit) const;
  template <class Descend>
  void share_out(const Search& search, ThreadTeam& team, std::vector<CellPair>& out,
                 const Descend& descend);

  std::size_t cloths_;
  std::vector<Levels> levels_;  // one a surface
  std::vector<MovingSurface> surfaces_;
  std::vector<NodePair> tasks_;
  SharedPairs shared_;
};

}  // namespace weft
