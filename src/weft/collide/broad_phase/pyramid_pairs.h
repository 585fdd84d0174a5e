#pragma once

#include <optional>
#include <vector>

#include "weft/collide/broad_phase/cell_tiles.h"
#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/broad_phase/path_boxes.h"
#include "weft/collide/broad_phase/unfolded_windows.h"

namespace weft {

/// Broad phase by the mip pyramids of the images as bounding hierarchies: boxes at both ends of the
/// step, certainly unfolded windows for a cloth with itself. Every patch of 4 x 4
/// cells of the one surface descends the pyramid of the other down to its patches; there each cell
/// is compared with whole tiles. All indices are implicit; fitting takes O(N).
class PyramidPairs final : public BroadPhase {
 public:
  /// @param grids  of all surfaces, kept by the caller; the first `cloths` are cloths
  PyramidPairs(std::span<const SurfaceGrid* const> grids, std::size_t cloths);

  void refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) override;
  void find(int surface_a, int surface_b, float reach, ThreadTeam& team,
            std::vector<CandidateTile>& out) override;
  void find_self(int surface, float reach, float slack, ThreadTeam& team,
                 std::vector<CandidateTile>& out) override;
  bool find_changed(int surface_a, int surface_b, float reach, const ChangedPatches& changed,
                    ThreadTeam& team, std::vector<CandidateTile>& out) override;
  [[nodiscard]] const PathBoxLevels* boxes(int surface) const override {
    return &levels_[static_cast<std::size_t>(surface)].boxes;
  }

 private:
  struct Levels {
    PathBoxLevels boxes;
    std::optional<UnfoldedWindows> folds;  // of cloths that were searched whole
    int fitted_to = 0;                     // name of the motion
  };
  /// Parameters of one search.
  struct Search {
    const CollideKernels* kernels;
    int a = 0, b = 0;
    float reach = 0;
    const UnfoldedWindows* unfolded = nullptr;  // of a cloth with itself
    const ChangedPatches* changed = nullptr;    // null: all are wanted
    [[nodiscard]] bool same() const { return a == b; }
  };
  /// A patch of the first surface, or the whole of a smaller one.
  struct Patch {
    const Search& search;
    Node node;
    PathBox box;
    PatchBoxes cells;
    unsigned place;  // see place_in_order
    bool changed;
    std::vector<CandidateTile>& out;
  };

  void search_all(const Search& search, ThreadTeam& team, std::vector<CandidateTile>& out);
  void search_patch(const Search& search, int patch, std::vector<CandidateTile>& out) const;
  /// Descends the second surface's pyramid from a node, and adds the pairs that may meet.
  void descend(const Patch& patch, const Node& node) const;
  /// Whether no pair of a patch and a node's parts is wanted, or one that may meet.
  [[nodiscard]] bool leaves_out(const Patch& patch, const Node& node) const;
  /// Adds the pairs of cells of a patch and of a node that is one.
  void pair_cells(const Patch& patch, const Node& node) const;
  /// Those of a tile's cells, which begins at a cell of the same surface, that are to be paired
  /// with a cell.
  [[nodiscard]] static unsigned wanted_cells(const UnfoldedWindows& unfolded, const Node& cell,
                                             const Node& tile, unsigned near);

  std::vector<Levels> levels_;  // one a surface
  std::vector<MovingSurface> surfaces_;
  ChunkedLists<std::vector<CandidateTile>> found_;
};

}  // namespace weft
