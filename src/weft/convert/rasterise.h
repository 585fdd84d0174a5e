#pragma once

#include <array>
#include <functional>

#include "weft/param/square_map.h"

namespace weft {

/// The uv of a triangle's corners.
using CornerUv = std::array<Vec2d, 3>;

/// Calls visit(row, col, triangle) for the interior samples of a grid over the map's chart and the
/// triangles that cover them: sidedness by exact orientation of the doubles as they
/// are, samples on an edge by a top-left rule, so that a valid map visits each sample exactly once.
void rasterise(const DiskMesh& disk, const SquareMap& map, ChartSize size,
               const std::function<void(int row, int col, int triangle)>& visit);

/// The position of a sample of a grid over the map's chart, in the map's units: of finer grids
/// between the places of the chart's own samples.
Vec2d sample_place(int row, int col, ChartSize size, const SquareMap& map);

/// Barycentric coordinates of a point in or next to a triangle: >= 0, summing to 1.
std::array<double, 3> corner_weights(const CornerUv& corners, Vec2d point);

CornerUv corner_uv(const SquareMap& map, const Triangle& triangle);

}  // namespace weft
