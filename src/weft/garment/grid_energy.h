#pragma once

#include <vector>

#include "weft/garment/grid_map.h"

namespace weft {

/// The energy of spread_inside, with areas d replaced by (d + sqrt(epsilon^2 + d^2)) / 2 where they
/// divide.
class GridEnergy {
 public:
  /// The wanted cell of a grid whose border stays: of the border's mean sides, or a square.
  enum class Cell { as_border, square };
  GridEnergy(const PlaneGrid& grid, Cell cell);

  void set_epsilon(double squared) { squared_epsilon_ = squared; }
  /// @param gradient  [rows * cols] by points; 0 on the border
  double measure(const PlaneGrid& grid, std::vector<Vec2d>& gradient) const;
  /// The least area of a pair of sides, in units of the wanted cell.
  [[nodiscard]] double min_area(const PlaneGrid& grid) const;

 private:
  /// Calls use(side along u, its first point, its second, side along v, ...) for all pairs of
  /// sides.
  template <class Use>
  void for_pairs(const PlaneGrid& grid, const Use& use) const;

  double per_u_ = 1, per_v_ = 1;  // 1 over the wanted sides
  double squared_epsilon_ = 0;
  bool corner_counts_[2][2];  // whether the corner of the grid is less than straight
};

}  // namespace weft
