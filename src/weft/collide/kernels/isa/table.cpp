#include "weft/collide/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {

const CollideKernels collide_kernels{edges,         join_windows, join_twos, find_unfolded,
                                     near_children, near_pairs,   along};

}  // namespace weft::WEFT_KERNEL_SET
