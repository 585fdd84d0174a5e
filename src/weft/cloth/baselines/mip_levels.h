#pragma once

#include "weft/geometry_image.h"
#include "weft/grid.h"

namespace weft {

// A geometry image is its own mip pyramid: the next coarser level holds every second sample.

/// Samples a side of the coarsest level.
constexpr int min_level_size = 3;

/// Whether every second border sample keeps its mates: all intervals begin and end on even places.
bool halves(const BorderMates& mates);
/// The mates of the next coarser level. Requires halves(mates).
BorderMates halved(const BorderMates& mates);

/// A row of the transpose of bilinear interpolation: weights 1/4 1/2 1/4, 1/2 1 1/2, 1/4 1/2 1/4.
/// @param fine    [n x n]
/// @param weight  [n x n] multiplies the fine values; null: 1
/// @param line    scratch of n values
/// @param out     [(n + 1) / 2] overwritten
void restrict_plane_row(const Grid<float>& fine, const Grid<float>* weight, int row, float* line,
                        float* out);

/// Adds a row of the bilinear interpolation of a coarse plane, times `weight` where there is one.
/// Samples that are mates get the same bits when those of the coarse plane do.
/// @param row     of the finer level, n samples a side
/// @param weight  [n], null: 1
/// @param out     [n]
void add_interpolated_row(const Grid<float>& coarse, int row, const float* weight, float* out);

}  // namespace weft
