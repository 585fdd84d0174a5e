#include "weft/cloth/kernels/newton_kernels.h"

#include "weft/core/instruction_set.h"

namespace weft {

namespace baseline {
extern const NewtonKernels newton;
}
namespace avx2 {
extern const NewtonKernels newton;
}
namespace avx512 {
extern const NewtonKernels newton;
}

const NewtonKernels& newton_kernels_for(InstructionSet set) {
  return choose(set, baseline::newton, avx2::newton, avx512::newton);
}

}  // namespace weft
