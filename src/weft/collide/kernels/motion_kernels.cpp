#include "weft/collide/kernels/motion_kernels.h"

#include "weft/core/instruction_set.h"

namespace weft {

namespace baseline {
extern const MotionKernels motion_kernels;
}
namespace avx2 {
extern const MotionKernels motion_kernels;
}
namespace avx512 {
extern const MotionKernels motion_kernels;
}

const MotionKernels& motion_kernels_for(InstructionSet set) {
  return choose(set, baseline::motion_kernels, avx2::motion_kernels, avx512::motion_kernels);
}

}  // namespace weft
