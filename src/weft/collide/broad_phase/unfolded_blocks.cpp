#include "weft/collide/broad_phase/unfolded_blocks.h"

#include <algorithm>
#include <utility>

#include "weft/collide/moving_surface.h"

namespace weft {
namespace {

/// How edges of a patch are edges of a strip: from which planes on, forwards or backwards (-1), and
/// to which.
struct EdgeTurn {
  int from, sign, to;
};

/// Widens a window's extents by those of a patch.
void widen(const Extents& patches, const EdgeTurn& turn, int patch, Extents& joined, int column) {
  const int side = patches.front().cols(), row = patch / side, col = patch % side;
  for (int k = 0; k < 3; ++k) {
    const float lower = patches[turn.from + k](row, col),
                upper = patches[turn.from + 3 + k](row, col);
    float& least = joined[turn.to + k](0, column);
    float& most = joined[turn.to + 3 + k](0, column);
    least = std::min(least, turn.sign > 0 ? lower : -upper);
    most = std::max(most, turn.sign > 0 ? upper : -lower);
  }
}

}  // namespace

/// Lays windows along strips.
class UnfoldedBlocks::Layout {
 public:
  Layout(const SurfaceGrid& grid, const ChartNodes& charts)
      : grid_(grid), charts_(charts), side_((grid.cells() + patch_side - 1) / patch_side) {}

  void add(const SeamStrips::Strip& strip, UnfoldedBlocks& out) {
    strip_ = &strip;
    columns_.clear();
    for (int col = 0; col < strip.count; ++col) columns_.push_back(column_at(col));
    std::vector<Range> runs;
    for (int col = 0; col < strip.count; ++col)
      if (runs.empty() || columns_[col][0][0] != columns_[col - 1][0][0])
        runs.push_back({col, col + 1});
      else
        ++runs.back().last;
    for (std::size_t i = 0; i < runs.size(); ++i)
      add_window({runs[i > 0 ? i - 1 : i].first, runs[std::min(i + 1, runs.size() - 1)].last}, out);
  }
  [[nodiscard]] int patches() const { return side_ * side_; }

 private:
  static constexpr int patch_side = PatchVersions::side;
  /// Patches at a place of the strip: on both sides, beside the seam and behind that; -1 for none.
  using Column = std::array<std::array<int, 2>, 2>;

  [[nodiscard]] int chart_of(int row, int col) const {
    if (row < 0 || col < 0 || row >= side_ || col >= side_) return ChartNodes::none;
    return charts_.chart_of(Node{PatchVersions::level, row, col});
  }

  [[nodiscard]] Column column_at(int col) const {
    Column column{{{-1, -1}, {-1, -1}}};
    for (int side = 0; side < 2; ++side) {
      const int cell = grid_.seams().column(*strip_, col)[1 + side];
      if (cell < 0) continue;
      const int r = cell / grid_.cells() / patch_side, c = cell % grid_.cells() / patch_side;
      const int chart = chart_of(r, c);
      if (chart < 0) continue;
      column[side][0] = r * side_ + c;
      const SeamStrips::Frame& frame = strip_->sides[side];
      const int inwards = side == 0 ? -frame.across : frame.across;
      const int row = frame.along_rows ? r + inwards : r,
                behind = frame.along_rows ? c : c + inwards;
      if (chart_of(row, behind) == chart) column[side][1] = row * side_ + behind;
    }
    return column;
  }

  /// Cells of a patch beside each other along the strip.
  [[nodiscard]] int length_of(int patch, bool along_rows) const {
    int length = 0;
    for (int i = 0; i < patch_side; ++i) {
      bool any = false;
      for (int j = 0; j < patch_side; ++j) {
        const int r = patch / side_ * patch_side + (along_rows ? j : i),
                  c = patch % side_ * patch_side + (along_rows ? i : j);
        any = any ||
              (r < grid_.cells() && c < grid_.cells() && !grid_.missing(r * grid_.cells() + c));
      }
      length += any ? 1 : 0;
    }
    return length;
  }

  /// Adds the patches of one depth of a side to a window.
  void take(Range columns, int side, int depth, Window& window, RowLists& members) const {
    const SeamStrips::Frame& frame = strip_->sides[side];
    for (int col = columns.first; col < columns.last;) {
      const int patch = columns_[col][side][depth], first = col;
      while (col < columns.last && columns_[col][side][depth] == patch) ++col;
      window.parts.push_back({patch, frame});
      if (col - first == length_of(patch, frame.along_rows)) members.add(patch);
    }
  }

  void add_window(Range columns, UnfoldedBlocks& out) const {
    const auto all_have = [&](int side, int depth) {
      return std::all_of(columns_.begin() + columns.first, columns_.begin() + columns.last,
                         [&](const Column& column) { return column[side][depth] >= 0; });
    };
    if (!all_have(0, 0) || !all_have(1, 0)) return;
    Window window;
    for (int side = 0; side < 2; ++side)
      for (int depth = 0; depth < (all_have(side, 1) ? 2 : 1); ++depth)
        take(columns, side, depth, window, out.members_);
    out.members_.end_row();
    out.windows_.push_back(std::move(window));
  }

  const SurfaceGrid& grid_;
  const ChartNodes& charts_;
  int side_;
  const SeamStrips::Strip* strip_ = nullptr;
  std::vector<Column> columns_;
};

UnfoldedBlocks::UnfoldedBlocks(const SurfaceGrid& grid, const ChartNodes& charts) {
  if (charts.empty() || level_sides(grid.cells()).size() <= PatchVersions::level) return;
  Layout layout(grid, charts);
  for (const SeamStrips::Strip& strip : grid.seams().strips()) layout.add(strip, *this);
  const int count = static_cast<int>(windows_.size());
  std::vector<std::vector<int>> windows_of(static_cast<std::size_t>(layout.patches()));
  for (int i = 0; i < count; ++i)
    for (const int patch : members_.row(i)) windows_of[patch].push_back(i);
  for (const std::vector<int>& windows : windows_of) {
    for (const int window : windows) windows_of_.add(window);
    windows_of_.end_row();
  }
  joined_ = extents(1, count);
  marks_ = Grid<float>(1, count);
  known_.resize(windows_.size());
}

void UnfoldedBlocks::join(const Window& window, const Extents& patches, int column) {
  for (int k = 0; k < 2 * edge_planes; ++k)
    joined_[k](0, column) = k % edge_planes < 3 ? HUGE_VALF : -HUGE_VALF;
  for (const Part& part : window.parts) {
    const int along = part.frame.along_rows ? 0 : edge_planes, across = edge_planes - along;
    widen(patches, {along, part.frame.along, 0}, part.patch, joined_, column);
    widen(patches, {across, part.frame.across, edge_planes}, part.patch, joined_, column);
  }
}

void UnfoldedBlocks::find_unfolded(const CollideKernels& kernels, const Extents& patches,
                                   float slack, Worker& worker) {
  const Range mine = worker.share(static_cast<int>(windows_.size()));
  if (mine.first >= mine.last) return;
  for (int i = mine.first; i < mine.last; ++i) join(windows_[i], patches, i);
  kernels.find_unfolded(mine.last - mine.first,
                        row_of(std::as_const(joined_), 0, mine.first).data(), slack,
                        marks_.row(0) + mine.first);
}

}  // namespace weft
