#include "weft/cloth/kernels/isa/newton_rows.h"

namespace weft::WEFT_KERNEL_SET {

const NewtonKernels newton{linearise,
                           gradient,
                           diagonal,
                           line_diagonals,
                           apply_springs,
                           spring_energy,
                           bend,
                           unbend,
                           apply_block_stencil,
                           add_block_row,
                           spring_blocks,
                           coarsen_columns,
                           coarsen_rows,
                           factor_lines,
                           factor_spring_lines,
                           factor_held_lines,
                           solve_lines,
                           solve_held_lines,
                           restrict_row,
                           prolong_row,
                           subtract,
                           scale_add,
                           scale_row,
                           add_scaled,
                           newton_dot,
                           largest};

}  // namespace weft::WEFT_KERNEL_SET
