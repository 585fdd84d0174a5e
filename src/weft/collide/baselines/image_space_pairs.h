#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/collide/baselines/depth_image.h"
#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/cell_tiles.h"
#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/broad_phase/unfolded_windows.h"

namespace weft {

/// Broad phase by culling in image space [govindaraju03] [govindaraju05]: blocks of 8 x 8 cells are
/// drawn into depth images along the axes, from both sides; a block that is before everything else
/// in one of them meets nothing and is dropped. The remaining blocks are paired by their boxes,
/// then by those of their cells. Neighbours, which always touch, ignore each other in the images.
class ImageSpacePairs final : public BroadPhase {
 public:
  /// @param grids  of all surfaces, kept by the caller; the first `cloths` are cloths
  ImageSpacePairs(std::span<const SurfaceGrid* const> grids, std::size_t cloths);

  void refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) override;
  void find(int surface_a, int surface_b, float reach, ThreadTeam& team,
            std::vector<CandidateTile>& out) override;
  void find_self(int surface, float reach, float slack, ThreadTeam& team,
                 std::vector<CandidateTile>& out) override;

 private:
  /// Layers of the image of a surface with itself: a block, its eight neighbours, and one more that
  /// counts.
  static constexpr int self_layers = 10;
  using Marks = std::vector<char>;
  struct Blocks {
    ExtentLevels boxes;
    int level = 0;           // of blocks
    Marks left;              // that are not culled yet [side * side]
    std::vector<int> order;  // those that are left, by their least x
    [[nodiscard]] int side() const { return boxes.sides()[static_cast<std::size_t>(level)]; }
    [[nodiscard]] int count() const { return side() * side(); }
    [[nodiscard]] const Box3f& box(int block) const {
      return boxes.at({level, block / side(), block % side()});
    }
  };

  [[nodiscard]] static bool touch(const Blocks& of, int block, int other);
  /// Calls visit(box, cell) for the cells of a block.
  template <class Visit>
  static void for_cells(const Blocks& of, int block, const Visit& visit);
  template <int Layers>
  static void draw(const Blocks& of, DepthImage<Layers>& image);
  /// Marks the blocks that are before all others in a view.
  template <int Layers, class Ignored>
  static void mark_seen(const Blocks& of, const DepthImage<Layers>& image, float reach,
                        const Ignored& ignored, Marks& seen);
  static bool drop(const std::array<Marks, view_count>& seen, Blocks& from);
  void cull(Blocks& a, Blocks& b, float reach, ThreadTeam& team);
  void cull_self(Blocks& of, float reach, ThreadTeam& team);
  static void sort(Blocks& of);
  template <class Emit>
  static void pair_cells(const Blocks& a, int block_a, const Blocks& b, int block_b, float reach,
                         const Emit& emit);

  std::vector<Blocks> blocks_;          // one a surface
  std::vector<UnfoldedWindows> folds_;  // one a cloth
  std::vector<int> fitted_to_;          // names of the surfaces' motions
  std::vector<MovingSurface> surfaces_;
  std::array<DepthImage<1>, view_count> images_a_, images_b_;
  std::array<DepthImage<self_layers>, view_count> self_images_;
  std::array<Marks, view_count> seen_a_, seen_b_;
  SharedPairs shared_;
};

}  // namespace weft
