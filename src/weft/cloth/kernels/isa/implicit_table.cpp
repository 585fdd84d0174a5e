#include "weft/cloth/kernels/isa/implicit_rows.h"

namespace weft::WEFT_KERNEL_SET {

const ImplicitKernels implicit{elastic,       axial_damping,    linearise,     multiply,
                               add_blocks,    add_mass,         invert_blocks, multiply_blocks,
                               gradient_step, update_direction, subtract,      restrict_plane,
                               fall,          right_side,       move,          advance};

}  // namespace weft::WEFT_KERNEL_SET
