#include "weft/cloth/kernels/rows/rows.h"

namespace weft::WEFT_KERNEL_SET {

const KernelTable table{springs,        spring_energy,   add_differences,
                        add_transposed, inertia,         turn,
                        place,          step_residual,   dot,
                        first_sweep,    apply,           add_right,
                        sweep,          subtract_blocks, apply_blocks,
                        block_sweep,    restrict_rows,   interpolate,
                        substitute,     breaks_limit,    limit,
                        motion};

}  // namespace weft::WEFT_KERNEL_SET
