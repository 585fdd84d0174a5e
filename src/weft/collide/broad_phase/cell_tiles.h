#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/broad_phase/tiling.h"
#include "weft/collide/kernels/collide_kernels.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Joins pairs of cells into tiles, ordered by cells, then tiles.
/// @param pairs  each once; reordered
void join_to_tiles(const Tiling& of_a, const Tiling& of_b, std::vector<CandidatePair>& pairs,
                   std::vector<CandidateTile>& out);

/// Collects pairs that a team finds, as tiles.
class SharedPairs {
 public:
  /// Calls find(i, mine) for i in 0 .. count - 1, which adds pairs to `mine`, and adds all to
  /// `out`.
  template <class Find>
  void collect(int count, std::array<Tiling, 2> tilings, ThreadTeam& team,
               std::vector<CandidateTile>& out, const Find& find) {
    found_.fill(count, team, find);
    pairs_.clear();
    append(found_, pairs_);
    join_to_tiles(tilings[0], tilings[1], pairs_, out);
  }

 private:
  ChunkedLists<std::vector<CandidatePair>> found_;
  std::vector<CandidatePair> pairs_;
};

/// The corners of a surface's cells at both ends of a step, tile by tile, so that one cell is
/// compared with those of a whole tile at once.
class CellTiles {
 public:
  /// @param grid  kept by reference
  explicit CellTiles(const SurfaceGrid& grid);
  /// Takes a step's motion, to be fitted when it is asked for.
  void take(const MovingSurface& surface) {
    surface_ = surface;
    ++motion_;
  }
  /// Copies the corners of the motion that was taken last: of all tiles, or of those that
  /// candidates have on their first or second side. Each is copied once.
  void fit(ThreadTeam& team);
  void fit(std::span<const CandidateTile> candidates, bool second, ThreadTeam& team);

  [[nodiscard]] const Tiling& tiling() const { return tiling_; }
  [[nodiscard]] const TileCorners& tile(int number) const { return corners_[number]; }
  [[nodiscard]] CellCorners cell(int row, int col) const;

 private:
  void want(int number);
  void fit_wanted(ThreadTeam& team);
  void fit_tile(int number);
  /// Cells that lie in no chart are near nothing.
  void hide_missing(int number, int rows, int cols);

  const SurfaceGrid* grid_;
  Tiling tiling_;
  std::vector<TileCorners> corners_;
  MovingSurface surface_;
  int motion_ = 0;           // counts those that were taken
  std::vector<int> fitted_;  // by tiles, the motion that each was fitted to last
  std::vector<int> wanted_;  // tiles
};

}  // namespace weft
