#include "weft/collide/broad_phase/unfolded_windows.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace weft {
namespace {

/// Levels of fewer rows of windows are left to one worker: barriers would cost more.
constexpr int min_shared_rows = 31;
/// Kernels take so many columns about as fast as one.
constexpr int lanes = 16;

}  // namespace

UnfoldedWindows::Lines::Lines(int side) : twos(extents(2, side)), threes(extents(1, side)) {
  const auto most = static_cast<std::size_t>(side / lanes) + 2;
  runs.reserve(most);
  joined_runs.reserve(most);
}

UnfoldedWindows::UnfoldedWindows(int cells) : sides_(level_sides(cells)) {
  for (const int side : sides_) {
    const int twos = side - 1, threes = std::max(0, side - 2);
    levels_.push_back(
        {side, extents(side, side), Grid<float>(twos, twos), Grid<float>(threes, threes), {}, {}});
    if (levels_.size() == 1) continue;  // windows of cells are not remembered
    levels_.back().two_known = Grid<float>(twos, twos);
    levels_.back().three_known = Grid<float>(threes, threes);
  }
}

void UnfoldedWindows::fill_row(const CollideKernels& kernels, const MovingSurface& surface,
                               int row) {
  Level& cells = levels_.front();
  const std::array from{&surface.start->x, &surface.start->y, &surface.start->z};
  const std::array to{&surface.end->x, &surface.end->y, &surface.end->z};
  const std::array out = row_of(cells.nodes, row);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array planes{out[k], out[k + 3], out[k + 6], out[k + 9]};
    kernels.edges(cells.side,
                  {from[k]->row(row), from[k]->row(row + 1), to[k]->row(row), to[k]->row(row + 1)},
                  planes.data());
  }
  hide_gaps(0, row);
}

/// What is in no chart adds nothing to extents, and nodes of several charts have such with which no
/// window passes the test.
void UnfoldedWindows::hide_gaps(std::size_t level, int row) {
  if (charts_.empty()) return;
  const std::array planes = row_of(levels_[level].nodes, row);
  const auto set = [&](int col, float lower) {
    for (std::size_t k = 0; k < planes.size(); ++k)
      planes[k][col] = k % edge_planes < 3 ? lower : -lower;
  };
  for (const int col : charts_.without(static_cast<int>(level), row)) set(col, beyond_extents);
  for (const int col : charts_.mixed(static_cast<int>(level), row)) set(col, -beyond_extents);
}

void UnfoldedWindows::clear_mixed(std::size_t level, int row) {
  if (charts_.empty()) return;
  const auto clear = [&](Grid<float>& marks, int size) {
    if (row >= marks.rows()) return;
    for (const int col : charts_.mixed_windows(static_cast<int>(level), row, size))
      marks(row, col) = 0;
  };
  clear(levels_[level].two_unfolded, 2);
  clear(levels_[level].three_unfolded, 3);
}

void UnfoldedWindows::take_charts(const SurfaceGrid& grid) {
  if (grid_ == &grid) return;
  grid_ = &grid;
  charts_ = ChartNodes(grid);
  blocks_ = UnfoldedBlocks(grid, charts_);
}

void UnfoldedWindows::join_row(const CollideKernels& kernels, std::size_t level, int row) {
  const Level& fine = levels_[level - 1];
  Level& coarse = levels_[level];
  const std::array a = row_of(fine.nodes, 2 * row);
  const std::array b = row_of(fine.nodes, std::min(2 * row + 1, fine.side - 1));
  const int whole = fine.side / 2;
  kernels.join_twos(whole, a.data(), b.data(), row_of(coarse.nodes, row).data());
  for (std::size_t k = 0; k < 12 && whole < coarse.side; ++k) {  // the last, of one column
    const float p = a[k][2 * whole], q = b[k][2 * whole];
    coarse.nodes[k](row, whole) = k % edge_planes < 3 ? std::min(p, q) : std::max(p, q);
  }
  hide_gaps(level, row);
}

void UnfoldedWindows::fit(const CollideKernels& kernels, const MovingSurface& surface,
                          Worker& worker) {
  const Range mine = worker.share(levels_.front().side);
  for (int r = mine.first; r < mine.last; ++r) fill_row(kernels, surface, r);
  fit_levels(sides_, worker,
             [&](int level, int row) { join_row(kernels, static_cast<std::size_t>(level), row); });
  worker.barrier();
}

/// Tests the windows that begin in a row and in the columns of `lines.runs`.
void UnfoldedWindows::find_unfolded_row(const CollideKernels& kernels, Level& level, float slack,
                                        int row, Lines& lines) {
  const int twos = level.two_unfolded.cols(), threes = level.three_unfolded.cols();
  const bool has_threes = row < level.three_unfolded.rows();
  const auto join_two = [&](int r, Range cols) {
    kernels.join_windows(cols.last - cols.first,
                         row_of(std::as_const(level.nodes), r, cols.first).data(),
                         row_of(std::as_const(level.nodes), r + 1, cols.first).data(),
                         row_of(lines.twos, r % 2, cols.first).data());
  };
  const auto find_unfolded = [&](Range cols, const Extents& of, int line, float* out) {
    kernels.find_unfolded(cols.last - cols.first, row_of(of, line, cols.first).data(), slack,
                          out + cols.first);
  };
  const bool is_joined = lines.joined == row && lines.joined_runs == lines.runs;
  for (const Range two : lines.runs) {
    // Windows of 3 x 3 nodes are joined from two of 2 x 2 in each row.
    const Range both{two.first, std::min(two.last + 1, twos)};
    if (!is_joined) join_two(row, both);
    find_unfolded(two, lines.twos, row % 2, level.two_unfolded.row(row));
    const Range three{two.first, std::min(two.last, threes)};
    if (!has_threes || three.first >= three.last) continue;
    join_two(row + 1, both);
    kernels.join_windows(three.last - three.first,
                         row_of(std::as_const(lines.twos), row % 2, three.first).data(),
                         row_of(std::as_const(lines.twos), (row + 1) % 2, three.first).data(),
                         row_of(lines.threes, 0, three.first).data());
    find_unfolded(three, lines.threes, 0, level.three_unfolded.row(row));
  }
  lines.joined = has_threes ? row + 1 : -1;
  std::swap(lines.joined_runs, lines.runs);
}

/// The columns of a row of windows that do not lie in unfolded windows of the level above, as whole
/// vectors.
void UnfoldedWindows::find_runs(std::size_t level, int row, std::vector<Range>& runs) const {
  const int cols = levels_[level].two_unfolded.cols();
  runs.clear();
  if (level + 1 == levels_.size() || levels_[level + 1].side < 2) return runs.push_back({0, cols});
  const Grid<float>& marks = levels_[level + 1].two_unfolded;
  const float* above = marks.row(std::min(row / 2, marks.rows() - 1));
  for (int c = 0; c < marks.cols(); ++c) {
    if (above[c] != 0) continue;
    const int first = 2 * c, last = c + 1 == marks.cols() ? cols : first + 2;
    if (!runs.empty() && last <= runs.back().last) continue;
    const Range own{std::max(0, std::min(first, cols - lanes)), std::min(first + lanes, cols)};
    if (!runs.empty() && own.first == runs.back().last)
      runs.back().last = own.last;
    else
      runs.push_back(own);
  }
}

void UnfoldedWindows::find_unfolded_rows(const CollideKernels& kernels, std::size_t index,
                                         float slack, Range rows, Lines& lines) {
  Level& level = levels_[index];
  lines.joined = -1;
  for (int r = rows.first; r < rows.last; ++r) {
    for (Grid<float>* marks : {&level.two_unfolded, &level.three_unfolded})
      if (r < marks->rows()) std::fill_n(marks->row(r), marks->cols(), 1.0F);
    find_runs(index, r, lines.runs);
    if (lines.runs.empty())
      lines.joined = -1;
    else
      find_unfolded_row(kernels, level, slack, r, lines);
    clear_mixed(index, r);
  }
}

void UnfoldedWindows::find_unfolded(const MovingSurface& surface, float slack, ThreadTeam& team) {
  const CollideKernels& kernels = collide_kernels_for(team.instructions());
  const int side = levels_.front().side;
  while (static_cast<int>(lines_.size()) < team.size()) lines_.push_back(Lines(side));
  take_charts(*surface.grid);
  seams_.take(surface.grid->seams(), side, team.size());
  team.run_if(side >= min_shared_cells, [&](Worker& worker) {
    fit(kernels, surface, worker);
    seams_.find_unfolded(kernels, levels_.front().nodes, 2 * slack, worker);
    if (levels_.size() > PatchVersions::level)
      blocks_.find_unfolded(kernels, levels_[PatchVersions::level].nodes, 2 * slack, worker);
    Lines& lines = lines_[static_cast<std::size_t>(worker.rank())];
    for (std::size_t level = levels_.size(); level-- > 0;) {
      const int rows = levels_[level].two_unfolded.rows();
      const bool shared = rows >= min_shared_rows;
      // Both ends of an edge may leave their paths, so edges get twice the slack.
      if (shared || worker.rank() == 0)
        find_unfolded_rows(kernels, level, 2 * slack, shared ? worker.share(rows) : Range{0, rows},
                           lines);
      if (shared || level == 0 || levels_[level - 1].two_unfolded.rows() >= min_shared_rows)
        worker.barrier();
    }
  });
}

bool UnfoldedWindows::unfolded(const CandidatePair& pair) const {
  if (seams_.unfolded(pair)) return true;
  const int side = levels_.front().side;
  Node a{0, pair.a / side, pair.a % side}, b{0, pair.b / side, pair.b % side};
  const auto patch_of = [](const Node& cell) {
    return Node{PatchVersions::level, cell.row / PatchVersions::side,
                cell.col / PatchVersions::side};
  };
  if (patches_unfolded_across(patch_of(a), patch_of(b))) return true;
  while (std::abs(a.row - b.row) > 2 || std::abs(a.col - b.col) > 2) {
    a = {a.level + 1, a.row / 2, a.col / 2};
    b = {b.level + 1, b.row / 2, b.col / 2};
  }
  return unfolded(a, b);
}

bool UnfoldedWindows::is_smooth(int row, int col) const {
  const Level& cells = levels_.front();
  const Grid<float>&twos = cells.two_unfolded, &threes = cells.three_unfolded;
  // All of these windows lie within the image.
  return row < threes.rows() && col >= neighbours && col < threes.cols() &&
         twos.row(row)[col] != 0 && twos.row(row)[col - 1] != 0 && threes.row(row)[col] != 0 &&
         threes.row(row)[col - neighbours] != 0;
}

void UnfoldedWindows::find_folded_neighbours(const SurfaceGrid& grid, int row,
                                             std::vector<CandidateTile>& out) const {
  const int side = levels_.front().side, last_row = std::min(side - 1, row + neighbours);
  for (int col = 0; col < side; ++col) {
    if (is_smooth(row, col) || grid.missing(row * side + col)) continue;
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    const Node cell{0, row, col};
    const auto add = [&](int r, int c) {
      const auto tile_row = static_cast<std::uint16_t>(r / Tiling::rows * Tiling::rows),
                 tile_col = static_cast<std::uint16_t>(c / Tiling::cols * Tiling::cols);
      const auto found = std::find_if(out.begin() + first, out.end(), [&](const auto& one) {
        return one.row_b == tile_row && one.col_b == tile_col;
      });
      const auto lane = static_cast<std::uint8_t>(1U << Tiling::lane_at(r, c));
      if (found == out.end())
        out.push_back({static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(col), tile_row,
                       tile_col, lane});
      else
        found->cells |= lane;
    };
    for (int r = row; r <= last_row; ++r)
      for (int c = r == row ? col + 1 : std::max(0, col - neighbours);
           c <= std::min(side - 1, col + neighbours); ++c)
        if (!grid.missing(r * side + c) && !unfolded(cell, Node{0, r, c})) add(r, c);
  }
}

}  // namespace weft
