#pragma once

#include <span>
#include <vector>

#include "weft/collide/baselines/polar_surface.h"

namespace weft {

/// An angular table around a centre: cell (row, col) lists the triangles that some ray of the cell
/// may meet, the nearest first. Rows run over the polar angle from +y, columns over the azimuth.
class PolarTable {
 public:
  /// @param size  cells a side, >= 1
  PolarTable(const GridSurface& surface, Vec3d centre, int size);

  /// The cell of a direction (any length; zero counts as +y).
  [[nodiscard]] int cell(Vec3d direction) const noexcept;
  /// Triangles of a cell, ordered by the distance of their nearest corner from the centre, then by
  /// index.
  [[nodiscard]] std::span<const int> entries(int cell) const noexcept {
    return std::span(entries_).subspan(starts_[cell], starts_[cell + 1] - starts_[cell]);
  }
  /// Farthest corner of all triangles of a cell and of the cells around it, from the centre; 0 when
  /// there is none. [m]
  [[nodiscard]] double farthest(int cell) const noexcept { return farthest_[cell]; }

 private:
  void fill(const GridSurface& surface, Vec3d centre);
  void sort_entries(const GridSurface& surface, Vec3d centre);
  void find_farthest(const GridSurface& surface, Vec3d centre);

  int size_ = 0;
  std::vector<int> starts_, entries_;  // [size * size + 1], compressed rows
  std::vector<float> farthest_;        // [size * size]
};

}  // namespace weft
