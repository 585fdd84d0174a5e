#pragma once

#include <array>
#include <cstddef>

#include "weft/grid.h"

namespace weft {

/// Of nodes or windows of cells, least x, y, z and largest x, y, z of the edges along rows, then of
/// those along columns, through a step.
using Extents = std::array<Grid<float>, 12>;

/// Planes of edges of one kind.
inline constexpr int edge_planes = 6;
/// Beyond all extents.
inline constexpr float beyond_extents = 1e30F;

inline Extents extents(int rows, int cols) {
  Extents made;
  for (Grid<float>& plane : made) plane = Grid<float>(rows, cols);
  return made;
}

/// From a column on.
inline std::array<float*, 12> row_of(Extents& planes, int row, int col = 0) {
  std::array<float*, 12> rows{};
  for (std::size_t k = 0; k < planes.size(); ++k) rows[k] = planes[k].row(row) + col;
  return rows;
}
inline std::array<const float*, 12> row_of(const Extents& planes, int row, int col = 0) {
  std::array<const float*, 12> rows{};
  for (std::size_t k = 0; k < planes.size(); ++k) rows[k] = planes[k].row(row) + col;
  return rows;
}

}  // namespace weft
