#include "weft/cloth/kernels/implicit_kernels.h"

#include "weft/core/instruction_set.h"

namespace weft {

namespace baseline {
extern const ImplicitKernels implicit;
}
namespace avx2 {
extern const ImplicitKernels implicit;
}
namespace avx512 {
extern const ImplicitKernels implicit;
}

const ImplicitKernels& implicit_kernels_for(InstructionSet set) {
  return choose(set, baseline::implicit, avx2::implicit, avx512::implicit);
}

}  // namespace weft
