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

void join_to_tiles(const Tiling& of_a, const Tiling& of_b, std::vector<CandidatePair>& pairs,
                   std::vector<CandidateTile>& out) {
  const auto tile = [&](const CandidatePair& pair) {
    return of_b.tile_at(pair.b / of_b.cells(), pair.b % of_b.cells());
  };
  std::sort(pairs.begin(), pairs.end(), [&](const CandidatePair& p, const CandidatePair& q) {
    if (p.a != q.a) return p.a < q.a;
    return tile(p) != tile(q) ? tile(p) < tile(q) : p.b < q.b;
  });
  int cell = -1, last = -1;
  for (const CandidatePair& pair : pairs) {
    const int row_a = pair.a / of_a.cells(), col_a = pair.a % of_a.cells();
    const int row_b = pair.b / of_b.cells(), col_b = pair.b % of_b.cells();
    if (pair.a != cell || tile(pair) != last) {
      cell = pair.a;
      last = tile(pair);
      out.push_back({static_cast<std::uint16_t>(row_a), static_cast<std::uint16_t>(col_a),
                     static_cast<std::uint16_t>(of_b.first_row(last)),
                     static_cast<std::uint16_t>(of_b.first_col(last))});
    }
    out.back().cells |= static_cast<std::uint8_t>(1U << Tiling::lane_at(row_b, col_b));
  }
}

CellTiles::CellTiles(const SurfaceGrid& grid)
    : grid_(&grid),
      tiling_(grid.cells()),
      corners_(static_cast<std::size_t>(tiling_.count())),
      fitted_(corners_.size(), -1) {
  wanted_.reserve(corners_.size());
  for (int r = 0; r < grid.cells(); ++r)
    for (int c = 0; c < grid.cells(); ++c)
      corners_[tiling_.tile_at(r, c)].falling[Tiling::lane_at(r, c)] =
          grid.triangle_corners(tiling_.cell_at(r, c), 0)[2] == 2 ? 1 : 0;
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
      if (!grid_->missing(
              tiling_.cell_at(tiling_.first_row(number) + r, tiling_.first_col(number) + c)))
        continue;
      for (int axis = 0; axis < 3; ++axis)
        for (int corner = 0; corner < 4; ++corner)
          to.start[axis][corner][lane] = to.end[axis][corner][lane] =
              std::numeric_limits<float>::quiet_NaN();
    }
}

void CellTiles::want(int number) {
  int& last = fitted_[static_cast<std::size_t>(number)];
  if (last != motion_) wanted_.push_back(number);
  last = motion_;
}

void CellTiles::fit_wanted(ThreadTeam& team) {
  const int count = static_cast<int>(wanted_.size());
  team.run_if(count >= min_shared_tiles, [&](const Worker& worker) {
    const Range mine = worker.share(count);
    for (int i = mine.first; i < mine.last; ++i) fit_tile(wanted_[static_cast<std::size_t>(i)]);
  });
}

void CellTiles::fit(ThreadTeam& team) {
  wanted_.clear();
  for (int number = 0; number < tiling_.count(); ++number) want(number);
  fit_wanted(team);
}

void CellTiles::fit(std::span<const CandidateTile> candidates, bool second, ThreadTeam& team) {
  wanted_.clear();
  for (const CandidateTile& one : candidates)
    want(second ? tiling_.tile_b(one) : tiling_.tile_at(one.row_a, one.col_a));
  fit_wanted(team);
}

CellCorners CellTiles::cell(int row, int col) const {
  const TileCorners& of = corners_[tiling_.tile_at(row, col)];
  const int lane = Tiling::lane_at(row, col);
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
