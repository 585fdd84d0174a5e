#include "weft/collide/broad_phase/cell_tiles.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace weft {
namespace {

/// Fewest tiles that are worth sharing.
constexpr int min_shared_tiles = 64;

}  // namespace

unsigned place_in_order(int row, int col) {
  const auto spread = [](auto of) {
    auto bits = static_cast<unsigned>(of);
    bits = (bits | bits << 8) & 0x00FF00FF;
    bits = (bits | bits << 4) & 0x0F0F0F0F;
    bits = (bits | bits << 2) & 0x33333333;
    return (bits | bits << 1) & 0x55555555;
  };
  return spread(row) << 1 | spread(col);
}

void join_to_tiles(const Tiling& of_first, const Tiling& of_second,
                   std::vector<CandidatePair>& pairs, std::vector<CandidateTile>& out) {
  const auto tile = [&](const CandidatePair& pair) { return of_second.tile_of(pair.b); };
  std::sort(pairs.begin(), pairs.end(), [&](const CandidatePair& p, const CandidatePair& q) {
    if (p.a != q.a) return p.a < q.a;
    return tile(p) != tile(q) ? tile(p) < tile(q) : p.b < q.b;
  });
  const std::size_t first = out.size();
  for (const CandidatePair& pair : pairs) {
    if (out.size() == first || out.back().cell != pair.a || out.back().tile != tile(pair))
      out.push_back({pair.a, tile(pair), 0, of_first.patch_of(pair.a), of_second.patch_of(pair.b)});
    out.back().cells |= 1U << of_second.lane_of(pair.b);
  }
}

CellTiles::CellTiles(const SurfaceGrid& grid)
    : grid_(&grid), tiling_(grid.cells()), corners_(static_cast<std::size_t>(tiling_.count())) {
  for (int cell = 0; cell < grid.cells() * grid.cells(); ++cell)
    corners_[tiling_.tile_of(cell)].falling[tiling_.lane_of(cell)] =
        grid.triangle_corners(cell, 0)[2] == 2 ? 1 : 0;
}

void CellTiles::fit_tile(int number) {
  constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();
  TileCorners& to = corners_[number];
  const int first_row = tiling_.first_row(number), first_col = tiling_.first_col(number);
  const int rows = std::min(Tiling::rows, tiling_.cells() - first_row),
            cols = std::min(Tiling::cols, tiling_.cells() - first_col);
  const bool whole = rows == Tiling::rows && cols == Tiling::cols;
  const std::array<const Grid<float>*, 6> planes{&surface_.start->x, &surface_.start->y,
                                                 &surface_.start->z, &surface_.end->x,
                                                 &surface_.end->y,   &surface_.end->z};
  for (int k = 0; k < 6; ++k)
    for (int corner = 0; corner < 4; ++corner) {
      float* lanes = (k < 3 ? to.start[k] : to.end[k - 3])[corner];
      const float* from = planes[k]->row(first_row + corner / 2) + first_col + corner % 2;
      if (whole) {
        std::memcpy(lanes, from, Tiling::cols * sizeof(float));
        std::memcpy(lanes + Tiling::cols, from + planes[k]->stride(), Tiling::cols * sizeof(float));
        continue;
      }
      std::fill_n(lanes, tile_cells, nowhere);
      for (int r = 0; r < rows; ++r)
        std::copy_n(from + r * planes[k]->stride(), cols, lanes + Tiling::cols * r);
    }
  if (grid_->has_missing()) hide_missing(number, rows, cols);
}

void CellTiles::hide_missing(int number, int rows, int cols) {
  TileCorners& to = corners_[number];
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < cols; ++c) {
      const int lane = r * Tiling::cols + c;
      if (!grid_->missing(tiling_.cell(number, lane))) continue;
      for (int axis = 0; axis < 3; ++axis)
        for (int corner = 0; corner < 4; ++corner)
          to.start[axis][corner][lane] = to.end[axis][corner][lane] =
              std::numeric_limits<float>::quiet_NaN();
    }
}

void CellTiles::fit(ThreadTeam& team) {
  if (fitted_) return;
  fitted_ = true;
  team.run_if(tiling_.count() >= min_shared_tiles, [&](const Worker& worker) {
    const Range mine = worker.share(tiling_.count());
    for (int tile = mine.first; tile < mine.last; ++tile) fit_tile(tile);
  });
}

CellCorners CellTiles::cell(int number) const {
  const TileCorners& of = corners_[tiling_.tile_of(number)];
  const int lane = tiling_.lane_of(number);
  CellCorners cell{};
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 4; ++corner) {
      cell.start[axis][corner] = of.start[axis][corner][lane];
      cell.end[axis][corner] = of.end[axis][corner][lane];
    }
  cell.falling = of.falling[lane];
  return cell;
}

}  // namespace weft
