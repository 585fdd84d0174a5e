#include "weft/collide/kernels/isa/body_rows.h"

namespace weft::WEFT_KERNEL_SET {

const BodyKernels body_kernels{find_near, find_near_tile, reach_row, leaf_extents};

}  // namespace weft::WEFT_KERNEL_SET
