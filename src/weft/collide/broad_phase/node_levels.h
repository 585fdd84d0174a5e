#pragma once

#include <array>
#include <vector>

#include "weft/collide/kernels/collide_kernels.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/thread_team.h"
#include "weft/grid.h"
#include "weft/vec.h"

namespace weft {

/// A node of a surface's mip pyramid: on level l it spans 2^l x 2^l cells (fewer at the last row
/// and column). Level 0 are the cells.
struct Node {
  int level = 0, row = 0, col = 0;
  friend bool operator==(const Node&, const Node&) = default;
};

/// How many nodes a side each level has: cells, then halves rounded up, down to 1.
std::vector<int> level_sides(int cells);

/// Fewest cells a side at which fitting a surface's levels is shared among workers.
inline constexpr int min_shared_cells = 96;

/// Calls visit(child) for a node's children, at most four, in row order.
template <class Visit>
void for_children(const Node& node, const std::vector<int>& sides, const Visit& visit) {
  const int side = sides[static_cast<std::size_t>(node.level - 1)];
  for (int r = 2 * node.row; r <= 2 * node.row + 1 && r < side; ++r)
    for (int c = 2 * node.col; c <= 2 * node.col + 1 && c < side; ++c)
      visit(Node{node.level - 1, r, c});
}

/// Calls fit_row(level, row) for all rows of the levels above the cells, each level after the one
/// below it; large levels are shared among workers. To be called by every worker once its share of
/// the cells is done; the levels that worker 0 fits alone are visible to the others after the next
/// barrier.
template <class FitRow>
void fit_levels(const std::vector<int>& sides, Worker& worker, const FitRow& fit_row) {
  constexpr int min_shared_side = 32;  // nodes
  bool shared = true;                  // the level before
  for (int level = 1; level < static_cast<int>(sides.size()); ++level) {
    if (shared) worker.barrier();
    const int side = sides[static_cast<std::size_t>(level)];
    shared = side >= min_shared_side;
    if (!shared && worker.rank() != 0) break;
    const Range rows = shared ? worker.share(side) : Range{0, side};
    for (int r = rows.first; r < rows.last; ++r) fit_row(level, r);
  }
}

/// An axis-aligned box in single precision.
struct Box3f {
  Vec3f lower, upper;
};
inline bool overlap(const Box3f& a, const Box3f& b, float reach) {
  return a.lower.x - b.upper.x <= reach && b.lower.x - a.upper.x <= reach &&
         a.lower.y - b.upper.y <= reach && b.lower.y - a.upper.y <= reach &&
         a.lower.z - b.upper.z <= reach && b.lower.z - a.upper.z <= reach;
}
inline float longest_side(const Box3f& box) {
  const Vec3f e = box.upper - box.lower;
  return e.x > e.y ? (e.x > e.z ? e.x : e.z) : (e.y > e.z ? e.y : e.z);
}

/// Bounding boxes of the cells below each node of a mip pyramid. The image is the tree, so fitting
/// takes minima and maxima only and nothing is ever built.
class ExtentLevels {
 public:
  ExtentLevels() = default;
  explicit ExtentLevels(int cells);

  /// Boxes of the cells, for the caller to fill: least x, y, z, largest x, y, z. [cells x cells]
  [[nodiscard]] std::array<Grid<float>, 6>& finest() { return finest_; }
  [[nodiscard]] const std::array<Grid<float>, 6>& finest() const { return finest_; }
  /// Fits all levels from finest(). To be called by every worker after a barrier; ends with one.
  void fit(Worker& worker);

  [[nodiscard]] const std::vector<int>& sides() const { return sides_; }
  [[nodiscard]] int top() const { return static_cast<int>(sides_.size()) - 1; }
  [[nodiscard]] const Box3f& at(const Node& node) const {
    const auto level = static_cast<std::size_t>(node.level);
    return boxes_[level][static_cast<std::size_t>(node.row) * sides_[level] + node.col];
  }

 private:
  void pack_row(int row);
  void fit_row(std::size_t level, int row);

  std::vector<int> sides_;
  std::array<Grid<float>, 6> finest_;
  std::vector<std::vector<Box3f>> boxes_;  // of each level [side * side]
};

/// Fills the boxes of a surface's cells over a step. To be called by every worker; ends with a
/// barrier. Boxes of positions that are not finite are unspecified.
void fill_position_extents(const Planes3& start, const Planes3& end, ExtentLevels& levels,
                           Worker& worker);

}  // namespace weft
