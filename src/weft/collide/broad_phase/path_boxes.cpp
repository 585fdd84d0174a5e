#include "weft/collide/broad_phase/path_boxes.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "weft/collide/broad_phase/min_max.h"

namespace weft {
namespace {

/// Extents of one coordinate of the corners of a row of cells.
void corner_extents(const Grid<float>& of, int row, float* lower, float* upper) {
  const int cells = of.cols() - 1;
  const float *a = of.row(row), *b = of.row(row + 1);
#pragma omp simd
  for (int i = 0; i < cells; ++i) {
    lower[i] = min(min(a[i], a[i + 1]), min(b[i], b[i + 1]));
    upper[i] = max(max(a[i], a[i + 1]), max(b[i], b[i + 1]));
  }
}

float min_of(const float (&of)[4]) { return min(min(of[0], of[1]), min(of[2], of[3])); }
float largest_of(const float (&of)[4]) { return max(max(of[0], of[1]), max(of[2], of[3])); }

constexpr float far = HUGE_VALF;
constexpr PathBox nan_box{{NAN, NAN, NAN}, {NAN, NAN, NAN}, {NAN, NAN, NAN}, {NAN, NAN, NAN}};
constexpr PathBox nowhere{{far, far, far}, {-far, -far, -far}, {far, far, far}, {-far, -far, -far}};

void put(const PathBox& box, int child, ChildPathBoxes& to) {
  for (int k = 0; k < 3; ++k) {
    to.lower_start[k][child] = box.lower_start[k];
    to.upper_start[k][child] = box.upper_start[k];
    to.lower_end[k][child] = box.lower_end[k];
    to.upper_end[k][child] = box.upper_end[k];
  }
}

}  // namespace

PathBoxLevels::PathBoxLevels(int cells) : sides_(level_sides(cells)) {
  for (Grid<float>& plane : cells_) plane = Grid<float>(cells, cells);
  children_.resize(sides_.size());
  for (std::size_t l = 1; l < sides_.size(); ++l)
    children_[l].resize(static_cast<std::size_t>(sides_[l]) * sides_[l]);
}

void PathBoxLevels::fill_row(const MovingSurface& surface, int row) {
  const std::array planes{&surface.start->x, &surface.start->y, &surface.start->z,
                          &surface.end->x,   &surface.end->y,   &surface.end->z};
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t at = k < 3 ? k : k + 3;
    corner_extents(*planes[k], row, cells_[at].row(row), cells_[at + 3].row(row));
  }
  if (surface.grid != nullptr && surface.grid->has_missing()) hide_missing(*surface.grid, row);
}

void PathBoxLevels::hide_missing(const SurfaceGrid& grid, int row) {
  for (int c = 0; c < grid.cells(); ++c) {
    if (!grid.missing(row * grid.cells() + c)) continue;
    for (std::size_t k = 0; k < 12; ++k) cells_[k](row, c) = k / 3 % 2 == 0 ? far : -far;
  }
}

PathBox PathBoxLevels::box_of(const Node& node) const {
  PathBox box{};
  if (node.level == 0) {
    for (int k = 0; k < 3; ++k) {
      box.lower_start[k] = cells_[k](node.row, node.col);
      box.upper_start[k] = cells_[k + 3](node.row, node.col);
      box.lower_end[k] = cells_[k + 6](node.row, node.col);
      box.upper_end[k] = cells_[k + 9](node.row, node.col);
    }
    return box;
  }
  const ChildPathBoxes& of = children(node);
  for (int k = 0; k < 3; ++k) {
    box.lower_start[k] = min_of(of.lower_start[k]);
    box.upper_start[k] = largest_of(of.upper_start[k]);
    box.lower_end[k] = min_of(of.lower_end[k]);
    box.upper_end[k] = largest_of(of.upper_end[k]);
  }
  return box;
}

TileBoxes PathBoxLevels::tile(int row, int col) const {
  constexpr int tile_rows = 2, tile_cols = 4;
  TileBoxes boxes;
  float* const planes[4] = {boxes.lower_start[0], boxes.upper_start[0], boxes.lower_end[0],
                            boxes.upper_end[0]};
  const int rows = std::min(tile_rows, sides_.front() - row),
            cols = std::min(tile_cols, sides_.front() - col);
  for (int k = 0; k < 12; ++k) {
    float* lanes = planes[k / 3] + k % 3 * tile_cells;
    if (rows == tile_rows && cols == tile_cols) {
      std::memcpy(lanes, cells_[k].row(row) + col, tile_cols * sizeof(float));
      std::memcpy(lanes + tile_cols, cells_[k].row(row + 1) + col, tile_cols * sizeof(float));
      continue;
    }
    std::fill_n(lanes, tile_cells, NAN);
    for (int r = 0; r < rows; ++r)
      std::copy_n(cells_[k].row(row + r) + col, cols, lanes + tile_cols * r);
  }
  return boxes;
}

PatchBoxes PathBoxLevels::patch(int row, int col) const {
  constexpr int side = 4;
  PatchBoxes boxes;
  for (int i = 0; i < patch_cells; ++i) {
    const int r = row + i / side, c = col + i % side;
    boxes.cells[i] = r < sides_.front() && c < sides_.front() ? box_of({0, r, c}) : nan_box;
  }
  return boxes;
}

void PathBoxLevels::fit_node(const Node& node) {
  const int below = sides_[node.level - 1];
  ChildPathBoxes& out =
      children_[node.level][static_cast<std::size_t>(node.row) * sides_[node.level] + node.col];
  for (int k = 0; k < 4; ++k) {
    const Node child{node.level - 1, 2 * node.row + k / 2, 2 * node.col + k % 2};
    const bool there = child.row < below && child.col < below;
    put(there ? box_of(child) : nowhere, k, out);
  }
}

void PathBoxLevels::pack_cells(const Node& node) {
  ChildPathBoxes& out = children_[1][static_cast<std::size_t>(node.row) * sides_[1] + node.col];
  const auto pack = [&](int plane, float(&to)[4]) {
    const float* first = cells_[plane].row(2 * node.row) + 2 * node.col;
    const float* second = cells_[plane].row(2 * node.row + 1) + 2 * node.col;
    to[0] = first[0];
    to[1] = first[1];
    to[2] = second[0];
    to[3] = second[1];
  };
  for (int k = 0; k < 3; ++k) {
    pack(k, out.lower_start[k]);
    pack(k + 3, out.upper_start[k]);
    pack(k + 6, out.lower_end[k]);
    pack(k + 9, out.upper_end[k]);
  }
}

void PathBoxLevels::fit_row(int level, int row) {
  const int side = sides_[level], below = sides_[level - 1];
  for (int c = 0; c < side; ++c) {
    const bool whole = 2 * row + 1 < below && 2 * c + 1 < below;
    if (level == 1 && whole) {
      pack_cells({level, row, c});
    } else {
      fit_node({level, row, c});
    }
  }
}

void PathBoxLevels::fit(const MovingSurface& surface, Worker& worker) {
  const Range mine = worker.share(sides_.front());
  for (int r = mine.first; r < mine.last; ++r) fill_row(surface, r);
  fit_levels(sides_, worker, [&](int level, int row) { fit_row(level, row); });
  if (worker.rank() == 0) root_ = box_of({top(), 0, 0});
  worker.barrier();
}

}  // namespace weft
