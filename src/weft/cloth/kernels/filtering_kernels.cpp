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
  switch (set) {
    case InstructionSet::avx512:
      return avx512::filtering;
    case InstructionSet::avx2:
      return avx2::filtering;
    default:
      return baseline::filtering;
  }
}

}  // namespace weft
