#include "weft/cloth/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {

const KernelTable table{springs,        spring_energy,   add_differences,
                        add_transposed, inertia,         update_direction,
                        place,          step_residual,   dot,
                        first_sweep,    apply,           add_rhs,
                        sweep,          subtract_blocks, apply_blocks,
                        block_sweep,    restrict_rows,   interpolate,
                        substitute,     breaks_limit,    limit,
                        motion};

}  // namespace weft::WEFT_KERNEL_SET
