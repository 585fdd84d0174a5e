#pragma once

#include "weft/collide/kernels/collide_kernels.h"

// The kernels of one instruction set, whose name WEFT_KERNEL_SET is.
namespace weft::WEFT_KERNEL_SET {

namespace {
inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }
}  // namespace

void edges(int n, const EdgeRows& rows, float* const* out);
void join_windows(int n, const float* const* a, const float* const* b, float* const* out);
void join_twos(int n, const float* const* a, const float* const* b, float* const* out);
void find_unfolded(int n, const float* const* extents, float slack, float* out);
unsigned near_children(const PathBox& node, const ChildPathBoxes& children, float reach);
void near_cells(const PatchBoxes& patch, const TileBoxes& tile, float reach, unsigned* out);
void tile_gaps(const CellCorners& cell, const TileCorners& tile, float at_start, float at_end,
               float* out);
void tile_reaches(const CellCorners& cell, const TileCorners& tile, float reach, float flat_reach,
                  float* near, float* near_edges);
void corner_over_tile(const CellCorners& cell, int corner, const TileCorners& tile,
                      const float* near, float beside, int* out);
void tile_over_cell(const CellCorners& cell, const TileCorners& tile, int corner, const float* near,
                    float beside, int* out);
void tile_edges(const CellCorners& cell, const TileCorners& tile, const float* near, int* out);

extern const CollideKernels collide_kernels;

}  // namespace weft::WEFT_KERNEL_SET
