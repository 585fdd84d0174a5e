#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/chart_nodes.h"
#include "weft/collide/broad_phase/extents.h"
#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/broad_phase/tiling.h"
#include "weft/collide/broad_phase/unfolded_blocks.h"
#include "weft/collide/broad_phase/unfolded_seams.h"
#include "weft/collide/kernels/collide_kernels.h"
#include "weft/grid.h"

namespace weft {

/// Finds rectangles of a cloth's image that certainly do not meet themselves during a step, from
/// the extents of their edges along rows and along columns.
///
/// Every triangle of a grid, whichever its diagonal, has one edge of each kind, so its gradient
/// lies in the boxes of these extents, at all times of a step, since edges move on straight lines.
/// Projected by the basis that is dual to the boxes' centres it becomes a 2 x 2 matrix near the
/// identity. If the symmetric part of all such matrices is positive definite,
/// (f(q) - f(p)) . (q - p) > 0 for every two points p and q of the rectangle, which is convex: no
/// two points of the surface coincide. Unlike cones of normals this needs no test of contours.
///
/// All windows of 2 x 2 and of 3 x 3 nodes on all levels of the mip pyramid are tested at once, row
/// by row from the coarsest level down, so that a search only looks them up. What lies within
/// unfolded windows of the level above is unfolded, too.
///
/// Of an image with gaps between its charts, windows are the part of them that is a chart; those of
/// several charts tell nothing. Cells and patches on both sides of a seam have windows of their
/// own, see UnfoldedSeams and UnfoldedBlocks.
class UnfoldedWindows {
 public:
  explicit UnfoldedWindows(int cells);
  /// Tests all windows for a step's motion, where any sample may still leave its path by `slack`.
  /// [m] @param surface  of the same grid each time
  void find_unfolded(const MovingSurface& surface, float slack, ThreadTeam& team);
  /// Whether some window that holds two nodes of one level is certainly unfolded; false where they
  /// are too far apart for one.
  [[nodiscard]] bool unfolded(const Node& a, const Node& b) const {
    const Level& level = levels_[static_cast<std::size_t>(a.level)];
    const auto [row, last_row] = std::minmax(a.row, b.row);
    const auto [col, last_col] = std::minmax(a.col, b.col);
    const int apart = std::max(last_row - row, last_col - col);
    if (apart > 2) return false;
    const int size = apart < 2 ? 2 : 3;
    const Grid<float>& marks = apart < 2 ? level.two_unfolded : level.three_unfolded;
    for (int r = std::max(0, last_row - size + 1); r <= std::min(row, marks.rows() - 1); ++r)
      for (int c = std::max(0, last_col - size + 1); c <= std::min(col, marks.cols() - 1); ++c)
        if (marks.row(r)[c] != 0) return true;
    return false;
  }
  /// Whether the whole image is certainly unfolded.
  [[nodiscard]] bool all_unfolded() const {
    return levels_.size() < 2 || levels_[levels_.size() - 2].two_unfolded.row(0)[0] != 0;
  }
  /// Whether some window across a seam that holds two cells is certainly unfolded.
  [[nodiscard]] bool unfolded_across(const CandidatePair& cells) const {
    return seams_.unfolded(cells);
  }
  /// Whether some window across a seam that holds two patches is certainly unfolded.
  [[nodiscard]] bool patches_unfolded_across(const Node& a, const Node& b) const {
    const int side = levels_.size() > PatchVersions::level ? sides_[PatchVersions::level] : 0;
    return blocks_.unfolded(a.row * side + a.col, b.row * side + b.col);
  }
  /// Calls visit(first node, nodes a side) for windows above the cells that were unfolded when
  /// this was called last and are not now.
  template <class Visit>
  void for_refolded(const Visit& visit) {
    blocks_.for_refolded([&](int patch) {
      const int side = sides_[PatchVersions::level];
      visit(Node{PatchVersions::level, patch / side, patch % side}, 1);
    });
    for (std::size_t level = 1; level < levels_.size(); ++level) {
      Level& of = levels_[level];
      for (int r = 0; r < of.two_unfolded.rows(); ++r)
        for_refolded_row({static_cast<int>(level), r, 0}, 2, of.two_unfolded, of.two_known, visit);
      for (int r = 0; r < of.three_unfolded.rows(); ++r)
        for_refolded_row({static_cast<int>(level), r, 0}, 3, of.three_unfolded, of.three_known,
                         visit);
    }
  }
  /// The same for two cells, on the first level that has a window for them.
  [[nodiscard]] bool unfolded(const CandidatePair& pair) const;
  /// Two cells at most so far apart along rows and along columns are neighbours, which a window of
  /// cells may hold.
  static constexpr int neighbours = 2;
  /// Adds the pairs of neighbours that are in no unfolded window, of the cells of a row with what
  /// is behind them or below. Cells that lie in no chart have no neighbours.
  void find_folded_neighbours(const SurfaceGrid& grid, int row,
                              std::vector<CandidateTile>& out) const;

 private:
  struct Level {
    int side = 0;  // nodes
    Extents nodes;
    Grid<float> two_unfolded, three_unfolded;  // 1 where the window that begins here is
    Grid<float> two_known, three_known;        // the same when refolded ones were asked for last
  };
  /// Scratch rows of a worker: extents of two rows of 2 x 2 windows in turn, of one of 3 x 3
  /// windows.
  struct Lines {
    explicit Lines(int side);
    Extents twos, threes;     // [2 x side], [1 x side]
    std::vector<Range> runs;  // columns of windows to be tested
    // The row of windows that `twos` has beforehand, and its columns.
    int joined = -1;
    std::vector<Range> joined_runs;
  };
  template <class Visit>
  static void for_refolded_row(Node first, int span, const Grid<float>& now, Grid<float>& known,
                               const Visit& visit) {
    const float* marks = now.row(first.row);
    float* before = known.row(first.row);
    if (std::equal(marks, marks + now.cols(), before)) return;
    for (; first.col < now.cols(); ++first.col)
      if (marks[first.col] == 0 && before[first.col] != 0) visit(first, span);
    std::copy_n(marks, now.cols(), before);
  }
  /// Whether all neighbours behind a cell or below are certainly in unfolded windows with it.
  [[nodiscard]] bool is_smooth(int row, int col) const;
  void fill_row(const CollideKernels& kernels, const MovingSurface& surface, int row);
  void join_row(const CollideKernels& kernels, std::size_t level, int row);
  void take_charts(const SurfaceGrid& grid);
  void hide_gaps(std::size_t level, int row);
  void clear_mixed(std::size_t level, int row);
  void fit(const CollideKernels& kernels, const MovingSurface& surface, Worker& worker);
  static void find_unfolded_row(const CollideKernels& kernels, Level& level, float slack, int row,
                                Lines& lines);
  void find_runs(std::size_t level, int row, std::vector<Range>& runs) const;
  void find_unfolded_rows(const CollideKernels& kernels, std::size_t index, float slack, Range rows,
                          Lines& lines);

  std::vector<int> sides_;
  std::vector<Level> levels_;
  std::vector<Lines> lines_;           // one a worker
  const SurfaceGrid* grid_ = nullptr;  // whose charts these are
  ChartNodes charts_;
  UnfoldedSeams seams_;
  UnfoldedBlocks blocks_;
};

}  // namespace weft
