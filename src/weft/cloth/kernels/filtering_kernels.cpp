#include "weft/cloth/kernels/filtering_kernels.h"

#include "weft/core/instruction_set.h"

namespace weft {

namespace baseline {
extern const FilteringKernels filtering;
}
namespace avx2 {
extern const FilteringKernels filtering;
}
namespace avx512 {
extern const FilteringKernels filtering;
}

const FilteringKernels& filtering_kernels_for(InstructionSet set) {
  return choose(set, baseline::filtering, avx2::filtering, avx512::filtering);
}

}  // namespace weft
