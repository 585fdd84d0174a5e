#pragma once

#include "weft/geometry_image.h"

namespace weft {

/// The diagonal that splits a quad of the grid: `rising` joins (row, col) and (row + 1, col + 1),
/// `falling` the other two corners.
enum class Diagonal : unsigned char { rising, falling };

/// A diagonal for each quad, [(n - 1) x (n - 1)] by the quad's smaller row and column: the shorter
/// one in space (of equal ones rising where row + col is even), but at the border the one that
/// keeps the topology once mates are joined, that is, under which no two edges join the same two
/// points.
Grid<Diagonal> choose_diagonals(const GeometryImage& image);

}  // namespace weft
