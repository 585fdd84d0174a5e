#include "weft/collide/pairs/unfolded_windows.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace weft {
namespace {

/// Levels of fewer nodes than this a side are joined by one worker.
constexpr int least_shared_side = 32;

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

std::array<Grid<float>, 12> planes(int side) {
  std::array<Grid<float>, 12> made;
  for (Grid<float>& plane : made) plane = Grid<float>(side, side);
  return made;
}

/// Whether a window of `size` nodes a side, some of whose places hold both rows and both columns,
/// is marked.
bool any_marked(const Grid<float>& marks, int size, std::pair<int, int> rows,
                std::pair<int, int> cols) {
  for (int r = std::max(0, rows.second - size + 1); r <= rows.first && r < marks.rows(); ++r)
    for (int c = std::max(0, cols.second - size + 1); c <= cols.first && c < marks.cols(); ++c)
      if (marks(r, c) != 0) return true;
  return false;
}

}  // namespace

UnfoldedWindows::UnfoldedWindows(int cells) {
  for (const int side : level_sides(cells)) {
    const int twos = side - 1, threes = std::max(0, side - 2);
    levels_.push_back({side, planes(side), planes(twos), planes(twos), Grid<float>(twos, twos),
                       Grid<float>(threes, threes)});
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
  bool shared = true;  // the level before
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    if (shared) worker.barrier();
    const int side = levels_[l].side;
    shared = side >= least_shared_side;
    if (!shared && worker.rank() != 0) break;
    const Range rows = shared ? worker.share(side) : Range{0, side};
    for (int r = rows.first; r < rows.last; ++r) join_row(kernels, l, r);
  }
  worker.barrier();
}

void UnfoldedWindows::judge_rows(const CollideKernels& kernels, Level& level, float slack,
                                 Worker& worker) {
  const auto join = [&](const Extents& of, int r, Extents& out) {
    kernels.join_windows(level.side - 1, row_of(of, r).data(), row_of(of, r + 1).data(),
                         row_of(out, r).data());
  };
  const Range twos = worker.share(std::max(0, level.side - 1));
  for (int r = twos.first; r < twos.last; ++r) {
    join(level.nodes, r, level.twos);
    kernels.judge(level.side - 1, row_of(std::as_const(level.twos), r).data(), slack,
                  level.two_unfolded.row(r));
  }
  worker.barrier();
  const Range threes = worker.share(std::max(0, level.side - 2));
  for (int r = threes.first; r < threes.last; ++r) {
    join(level.twos, r, level.threes);
    kernels.judge(level.side - 2, row_of(std::as_const(level.threes), r).data(), slack,
                  level.three_unfolded.row(r));
  }
}

void UnfoldedWindows::judge(const MovingSurface& surface, float slack, ThreadTeam& team) {
  const CollideKernels& kernels = collide_kernels_for(team.instructions());
  team.run([&](Worker& worker) {
    fit(kernels, surface, worker);
    // Of an edge both ends may leave their paths.
    for (Level& level : levels_) judge_rows(kernels, level, 2 * slack, worker);
  });
}

bool UnfoldedWindows::unfolded(const Node& a, const Node& b) const {
  const Level& level = levels_[static_cast<std::size_t>(a.level)];
  const std::pair rows = std::minmax(a.row, b.row), cols = std::minmax(a.col, b.col);
  const int apart = std::max(rows.second - rows.first, cols.second - cols.first);
  if (apart > 2 || level.side < 2) return false;
  return any_marked(apart < 2 ? level.two_unfolded : level.three_unfolded, apart < 2 ? 2 : 3, rows,
                    cols);
}

bool UnfoldedWindows::unfolded(const CellPair& pair) const {
  const int side = levels_.front().side;
  Node a{0, pair.a / side, pair.a % side}, b{0, pair.b / side, pair.b % side};
  while (std::abs(a.row - b.row) > 2 || std::abs(a.col - b.col) > 2) {
    a = {a.level + 1, a.row / 2, a.col / 2};
    b = {b.level + 1, b.row / 2, b.col / 2};
  }
  return unfolded(a, b);
}

}  // namespace weft
