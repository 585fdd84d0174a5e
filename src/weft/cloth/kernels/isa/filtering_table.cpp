#include "weft/cloth/kernels/isa/filtering_rows.h"

namespace weft::WEFT_KERNEL_SET {

const FilteringKernels filtering{viscous_springs, scale,    accelerate, moments,
                                 dense_rows,      add_rows, patch_row};

}  // namespace weft::WEFT_KERNEL_SET
