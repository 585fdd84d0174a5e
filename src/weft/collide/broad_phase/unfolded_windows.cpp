#include "weft/collide/broad_phase/unfolded_windows.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace weft {
namespace {

/// Levels of fewer rows of windows are left to one worker: barriers would cost more.
constexpr int min_shared_rows = 31;

std::array<float*, 12> row_of(std::array<Grid<float>, 12>& planes, int row) {
  std::array<float*, 12> rows{};
  for (std::size_t k = 0; k < 12; ++k) rows[k] = planes[k].row(row);
  return rows;
}
std::array<const float*, 12> row_of(const std::array<Grid<float>, 12>& planes, int row) {
  std::array<const float*, 12> rows{};
  for (std::size_t k = 0; k < 12; ++k) rows[k] = planes[k].row(row);
  return rows;
}

std::array<Grid<float>, 12> planes(int rows, int cols) {
  std::array<Grid<float>, 12> made;
  for (Grid<float>& plane : made) plane = Grid<float>(rows, cols);
  return made;
}

}  // namespace

UnfoldedWindows::UnfoldedWindows(int cells) : sides_(level_sides(cells)) {
  for (const int side : sides_) {
    const int twos = side - 1, threes = std::max(0, side - 2);
    levels_.push_back(
        {side, planes(side, side), Grid<float>(twos, twos), Grid<float>(threes, threes)});
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
}

void UnfoldedWindows::join_row(const CollideKernels& kernels, std::size_t level, int row) {
  const Level& fine = levels_[level - 1];
  Level& coarse = levels_[level];
  const std::array a = row_of(fine.nodes, 2 * row);
  const std::array b = row_of(fine.nodes, std::min(2 * row + 1, fine.side - 1));
  const int whole = fine.side / 2;
  kernels.join_twos(whole, a.data(), b.data(), row_of(coarse.nodes, row).data());
  if (coarse.side == whole) return;
  for (std::size_t k = 0; k < 12; ++k) {  // the last, of one column
    const float p = a[k][2 * whole], q = b[k][2 * whole];
    coarse.nodes[k](row, whole) = k % 6 < 3 ? std::min(p, q) : std::max(p, q);
  }
}

void UnfoldedWindows::fit(const CollideKernels& kernels, const MovingSurface& surface,
                          Worker& worker) {
  const Range mine = worker.share(levels_.front().side);
  for (int r = mine.first; r < mine.last; ++r) fill_row(kernels, surface, r);
  fit_levels(sides_, worker,
             [&](int level, int row) { join_row(kernels, static_cast<std::size_t>(level), row); });
  worker.barrier();
}

void UnfoldedWindows::find_unfolded_row(const CollideKernels& kernels, Level& level, float slack,
                                        int row, Lines& lines) {
  const int twos = level.two_unfolded.cols(), threes = level.three_unfolded.cols();
  const auto join_two = [&](int r) {
    kernels.join_windows(twos, row_of(std::as_const(level.nodes), r).data(),
                         row_of(std::as_const(level.nodes), r + 1).data(),
                         row_of(lines.twos, r % 2).data());
  };
  const auto find_unfolded = [&](int count, const Extents& of, int line, float* out) {
    kernels.find_unfolded(count, row_of(of, line).data(), slack, out);
  };
  if (lines.joined != row) join_two(row);
  find_unfolded(twos, lines.twos, row % 2, level.two_unfolded.row(row));
  lines.joined = -1;
  if (row >= level.three_unfolded.rows()) return;
  join_two(row + 1);
  lines.joined = row + 1;
  kernels.join_windows(threes, row_of(std::as_const(lines.twos), row % 2).data(),
                       row_of(std::as_const(lines.twos), (row + 1) % 2).data(),
                       row_of(lines.threes, 0).data());
  find_unfolded(threes, lines.threes, 0, level.three_unfolded.row(row));
}

/// Whether all windows that begin in a row of a level lie in unfolded windows of the level above.
bool UnfoldedWindows::unfolded_above(std::size_t level, int row) const {
  if (level + 1 == levels_.size() || levels_[level + 1].side < 2) return false;
  const Grid<float>& marks = levels_[level + 1].two_unfolded;
  const float* above = marks.row(std::min(row / 2, marks.rows() - 1));
  return std::all_of(above, above + marks.cols(), [](float mark) { return mark != 0; });
}

void UnfoldedWindows::find_unfolded_rows(const CollideKernels& kernels, std::size_t index,
                                         float slack, Range rows, Lines& lines) {
  Level& level = levels_[index];
  lines.joined = -1;
  for (int r = rows.first; r < rows.last; ++r) {
    if (!unfolded_above(index, r)) {
      find_unfolded_row(kernels, level, slack, r, lines);
      continue;
    }
    for (Grid<float>* marks : {&level.two_unfolded, &level.three_unfolded})
      if (r < marks->rows()) std::fill_n(marks->row(r), marks->cols(), 1.0F);
  }
}

void UnfoldedWindows::find_unfolded(const MovingSurface& surface, float slack, ThreadTeam& team) {
  const CollideKernels& kernels = collide_kernels_for(team.instructions());
  const int side = levels_.front().side;
  while (static_cast<int>(lines_.size()) < team.size())
    lines_.push_back({planes(2, side), planes(1, side)});
  team.run_if(side >= min_shared_cells, [&](Worker& worker) {
    fit(kernels, surface, worker);
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
  const int side = levels_.front().side;
  Node a{0, pair.a / side, pair.a % side}, b{0, pair.b / side, pair.b % side};
  while (std::abs(a.row - b.row) > 2 || std::abs(a.col - b.col) > 2) {
    a = {a.level + 1, a.row / 2, a.col / 2};
    b = {b.level + 1, b.row / 2, b.col / 2};
  }
  return unfolded(a, b);
}

}  // namespace weft
