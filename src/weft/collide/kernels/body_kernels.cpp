#include "weft/collide/kernels/body_kernels.h"

#include "weft/core/instruction_set.h"

namespace weft {

namespace baseline {
extern const BodyKernels body_kernels;
}
namespace avx2 {
extern const BodyKernels body_kernels;
}
namespace avx512 {
extern const BodyKernels body_kernels;
}

const BodyKernels& body_kernels_for(InstructionSet set) {
  return choose(set, baseline::body_kernels, avx2::body_kernels, avx512::body_kernels);
}

}  // namespace weft
