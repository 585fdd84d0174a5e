#include "weft/collide/broad_phase/unfolded_seams.h"

#include <algorithm>
#include <utility>

namespace weft {
namespace {

/// Takes the extents of one kind of edges, or of their opposites.
void take_edges(const Extents& from, int kind, int sign, int row, int col, Extents& to, int to_kind,
                int to_row, int to_col) {
  for (int k = 0; k < 3; ++k) {
    const float lower = from[kind + k](row, col), upper = from[kind + 3 + k](row, col);
    to[to_kind + k](to_row, to_col) = sign > 0 ? lower : -upper;
    to[to_kind + 3 + k](to_row, to_col) = sign > 0 ? upper : -lower;
  }
}

/// Whether a window of `size` columns that holds two of them, of so many in all, is marked.
bool any_marked(const float* marks, int count, int size, int col, int last_col) {
  for (int c = std::max(0, last_col - size + 1); c <= std::min(col, count - size); ++c)
    if (marks[c] != 0) return true;
  return false;
}

}  // namespace

UnfoldedSeams::Lines::Lines(int side)
    : cells(extents(SeamStrips::rows, side)), twos(extents(3, side)), threes(extents(1, side)) {}

void UnfoldedSeams::take(const SeamStrips& seams, int side, int workers) {
  seams_ = &seams;
  marks_.assign(static_cast<std::size_t>(kinds) * seams.columns(), 0.0F);
  if (seams.strips().empty()) return;
  while (static_cast<int>(lines_.size()) < workers) lines_.push_back(Lines(side));
}

void UnfoldedSeams::fill(const SeamStrips::Strip& strip, const Extents& cells, Lines& lines) const {
  const int side = cells.front().cols();
  for (int col = 0; col < strip.count; ++col)
    for (int row = 0; row < SeamStrips::rows; ++row) {
      const int cell = seams_->column(strip, col)[row];
      if (cell < 0) {  // no window that holds it passes the test
        for (int k = 0; k < 2 * edge_planes; ++k)
          lines.cells[k](row, col) = k % edge_planes < 3 ? -beyond_extents : beyond_extents;
        continue;
      }
      const SeamStrips::Frame& frame = strip.sides[row / 2];
      const int along = frame.along_rows ? 0 : edge_planes, across = edge_planes - along;
      const int r = cell / side, c = cell % side;
      take_edges(cells, along, frame.along, r, c, lines.cells, 0, row, col);
      take_edges(cells, across, frame.across, r, c, lines.cells, edge_planes, row, col);
    }
}

void UnfoldedSeams::find_unfolded(const CollideKernels& kernels, const SeamStrips::Strip& strip,
                                  float slack, Lines& lines) {
  const int twos = strip.count - 1, threes = strip.count - 2;
  if (twos < 1) return;
  const auto rows = [](const Extents& of, int row) { return row_of(of, row); };
  for (int row = 0; row < 3; ++row)
    kernels.join_windows(twos, rows(lines.cells, row).data(), rows(lines.cells, row + 1).data(),
                         row_of(lines.twos, row).data());
  kernels.find_unfolded(twos, rows(lines.twos, 1).data(), slack, marks(strip, 0));
  for (int row = 0; row < 2 && threes > 0; ++row) {
    kernels.join_windows(threes, rows(lines.twos, row).data(), rows(lines.twos, row + 1).data(),
                         row_of(lines.threes, 0).data());
    kernels.find_unfolded(threes, rows(lines.threes, 0).data(), slack, marks(strip, 1 + row));
  }
}

void UnfoldedSeams::find_unfolded(const CollideKernels& kernels, const Extents& cells, float slack,
                                  Worker& worker) {
  const std::span<const SeamStrips::Strip> strips = seams_->strips();
  if (strips.empty()) return;
  Lines& lines = lines_[static_cast<std::size_t>(worker.rank())];
  const Range mine = worker.share(static_cast<int>(strips.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    fill(strips[i], cells, lines);
    find_unfolded(kernels, strips[i], slack, lines);
  }
}

bool UnfoldedSeams::unfolded(const SeamStrips::Place& a, const SeamStrips::Place& b) const {
  const SeamStrips::Strip& strip = seams_->strips()[a.strip];
  const auto [col, last_col] = std::minmax(a.col, b.col);
  const auto [row, last_row] = std::minmax(a.row, b.row);
  const auto marked = [&](int kind, int size) {
    return any_marked(marks(strip, kind), strip.count, size, col, last_col);
  };
  return (row >= 1 && last_row <= 2 && marked(0, 2)) || (last_row <= 2 && marked(1, 3)) ||
         (row >= 1 && marked(2, 3));
}

}  // namespace weft
