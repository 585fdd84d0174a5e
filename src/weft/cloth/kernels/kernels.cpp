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
  return choose(set, baseline::table, avx2::table, avx512::table);
}

}  // namespace weft
