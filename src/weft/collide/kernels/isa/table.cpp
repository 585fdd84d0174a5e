#include "weft/collide/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {

const CollideKernels collide_kernels{
    edges,     join_windows, join_twos,        find_unfolded,  near_children, near_cells,
    tile_gaps, tile_reaches, corner_over_tile, tile_over_cell, tile_edges};

}  // namespace weft::WEFT_KERNEL_SET
