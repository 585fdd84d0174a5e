#pragma once

#include <vector>

#include "weft/collide/broad_phase/node_levels.h"

namespace weft {

/// When the patches of a surface, nodes of 4 x 4 cells, have changed last, as a mip pyramid of the
/// latest versions.
class PatchVersions {
 public:
  /// Level of patches in the mip pyramid of cells.
  static constexpr int level = 2, side = 1 << level;

  /// All have version -1. @param cells  a side
  explicit PatchVersions(int cells);

  [[nodiscard]] int patches() const { return sides_.front(); }  ///< a side
  [[nodiscard]] int of(int patch) const { return versions_.front()[patch]; }
  /// The latest version of the patches in a node; patches and coarser nodes have one.
  [[nodiscard]] int of(const Node& node) const {
    const auto index = static_cast<std::size_t>(node.level - level);
    return versions_[index][static_cast<std::size_t>(node.row) * sides_[index] + node.col];
  }
  /// The latest version of all.
  [[nodiscard]] int latest() const { return versions_.back().front(); }

  /// Gives a patch a version that is not below those before.
  void set(int row, int col, int version);
  void set_all(int version);
  /// Takes the patches that have a version elsewhere, which is the latest there.
  void take(const PatchVersions& from, int version);
  /// The same for all patches that share cells with a square.
  /// @param first  node at its upper left  @param span  nodes of that level a side
  void set_square(const Node& first, int span, int version);

 private:
  std::vector<int> sides_;  // of levels, from patches up
  std::vector<std::vector<int>> versions_;
};

}  // namespace weft
