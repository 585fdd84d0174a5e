#pragma once

#include "weft/geometry_image.h"

namespace weft {

/// Which way a quad of the grid is split: `rising` joins (row, col) and (row + 1, col + 1),
/// `falling` the other two corners. `none`: the quad is in no chart, there is no surface.
enum class Diagonal : unsigned char { rising, falling, none };

/// A diagonal for each quad, [(n - 1) x (n - 1)] by the quad's least row and column: the shorter
/// one in space (of equal ones rising where row + col is even), but at the border of a chart the
/// one that keeps the topology once mates are joined, that is, under which no two edges join the
/// same two points. Files hold no triangles, so this rule is part of their format: docs/formats.md
/// tells it whole.
Grid<Diagonal> choose_diagonals(const GeometryImage& image);

}  // namespace weft
