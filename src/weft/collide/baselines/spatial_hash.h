#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/cell_tiles.h"
#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/broad_phase/unfolded_windows.h"

namespace weft {

/// Spatial hash of the cells of one surface.
class HashedCells {
 public:
  explicit HashedCells(int cells);
  /// Fits the boxes of all cells and the table to a step's motion.
  void fit(const MovingSurface& surface, ThreadTeam& team);

  /// The side of a cube of space [m].
  [[nodiscard]] double side() const { return side_; }
  [[nodiscard]] int count() const { return extents_.sides().front() * extents_.sides().front(); }
  [[nodiscard]] const Box3f& box(int cell) const {
    const int side = extents_.sides().front();
    return extents_.at({0, cell / side, cell % side});
  }
  /// Calls visit(cell) for each of its cells whose box comes within `reach` of another, once.
  template <class Visit>
  void for_near(const Box3f& other, float reach, const Visit& visit) const;

 private:
  /// A cube of space by its integer coordinates.
  using Cube = std::array<int, 3>;
  struct CubeRange {
    Cube first, last;
    [[nodiscard]] double count() const;
  };
  struct Entry {
    Cube cube{};
    int cell = 0;
  };

  [[nodiscard]] CubeRange cubes_of(const Box3f& box, double reach) const;
  [[nodiscard]] std::size_t bucket(const Cube& cube) const;
  template <class Visit>
  static void for_cubes(const CubeRange& range, const Visit& visit);
  /// Calls visit(cell, cube) for all cubes of cells that are not large.
  template <class Visit>
  void for_entries(const Visit& visit) const;
  void choose_side(const MovingSurface& surface);
  void fill_table();

  ExtentLevels extents_;
  std::vector<float> lengths_;  // of the boxes' longest sides
  double side_ = 1;
  std::vector<std::size_t> starts_;  // [buckets + 1]
  std::vector<std::size_t> next_;    // [buckets]
  std::vector<Entry> entries_;       // compressed rows, cells ascending in each
  std::vector<int> large_;           // cells that sweep too many cubes to be entered
};

/// Spatial hashing [teschner03]: in a first pass the vertices of a surface enter a hash table, by
/// the cubes of space of about a mean edge's length that they lie in; in a second pass the
/// primitives of the other look up the cubes that they meet. Here a vertex stands for the cell of
/// the image that begins with it and enters all cubes that this cell may pass in a step, so that
/// crossing edges are found as well.
class SpatialHashPairs final : public BroadPhase {
 public:
  /// @param grids  of all surfaces, kept by the caller; the first `cloths` are cloths
  SpatialHashPairs(std::span<const SurfaceGrid* const> grids, std::size_t cloths);

  void refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) override;
  void find(int surface_a, int surface_b, float reach, ThreadTeam& team,
            std::vector<CandidateTile>& out) override;
  void find_self(int surface, float reach, float slack, ThreadTeam& team,
                 std::vector<CandidateTile>& out) override;

 private:
  std::vector<HashedCells> tables_;     // one a surface
  std::vector<UnfoldedWindows> folds_;  // one a cloth
  std::vector<int> fitted_to_;          // names of the surfaces' motions
  std::vector<MovingSurface> surfaces_;
  SharedPairs shared_;
};

}  // namespace weft
