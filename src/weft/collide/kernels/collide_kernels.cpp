#include "weft/collide/kernels/collide_kernels.h"

#include "weft/core/instruction_set.h"

namespace weft {

namespace baseline {
extern const CollideKernels collide_kernels;
}
namespace avx2 {
extern const CollideKernels collide_kernels;
}
namespace avx512 {
extern const CollideKernels collide_kernels;
}

const CollideKernels& collide_kernels_for(InstructionSet set) {
  return choose(set, baseline::collide_kernels, avx2::collide_kernels, avx512::collide_kernels);
}

}  // namespace weft
