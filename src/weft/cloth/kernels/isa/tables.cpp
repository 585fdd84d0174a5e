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

const FilteringKernels filtering{viscous_springs, scale,    accelerate, moments,
                                 dense_rows,      add_rows, patch_row};

const ImplicitKernels implicit{elastic,       axial_damping,    linearise,     multiply,
                               add_blocks,    add_mass,         invert_blocks, multiply_blocks,
                               gradient_step, update_direction, subtract,      restrict_plane,
                               fall,          right_side,       move,          advance};

const NewtonKernels newton{linearise_far,
                           far_energy,
                           begin_step,
                           follow_guess,
                           linearise,
                           near_energy,
                           line_diagonals,
                           apply_springs,
                           apply_stencil,
                           add_block_row,
                           bend,
                           unbend,
                           coarsen_columns,
                           coarsen_springs,
                           coarsen_rows,
                           factor_lines,
                           factor_held_lines,
                           solve_lines,
                           solve_held_lines,
                           restrict_row,
                           prolong_row,
                           scale_row,
                           add_scaled,
                           newton_dot,
                           update,
                           advance};

}  // namespace weft::WEFT_KERNEL_SET
