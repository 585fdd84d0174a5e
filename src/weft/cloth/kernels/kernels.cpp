#include "weft/cloth/kernels/kernel_table.h"
#include "weft/core/instruction_set.h"

namespace weft {

namespace baseline {
extern const KernelTable table;
}
namespace avx2 {
extern const KernelTable table;
}
namespace avx512 {
extern const KernelTable table;
}

const KernelTable& kernels_for(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return avx512::table;
    case InstructionSet::avx2:
      return avx2::table;
    default:
      return baseline::table;
  }
}

}  // namespace weft
