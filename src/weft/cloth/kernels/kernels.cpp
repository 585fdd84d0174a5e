#include "weft/cloth/kernels/filtering_kernels.h"
#include "weft/cloth/kernels/implicit_kernels.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/cloth/kernels/newton_kernels.h"
#include "weft/core/instruction_set.h"

namespace weft {

namespace baseline {
extern const KernelTable table;
extern const FilteringKernels filtering;
extern const ImplicitKernels implicit;
extern const NewtonKernels newton;
}  // namespace baseline
namespace avx2 {
extern const KernelTable table;
extern const FilteringKernels filtering;
extern const ImplicitKernels implicit;
extern const NewtonKernels newton;
}  // namespace avx2
namespace avx512 {
extern const KernelTable table;
extern const FilteringKernels filtering;
extern const ImplicitKernels implicit;
extern const NewtonKernels newton;
}  // namespace avx512

const KernelTable& kernels_for(InstructionSet set) {
  return choose(set, baseline::table, avx2::table, avx512::table);
}

const FilteringKernels& filtering_kernels_for(InstructionSet set) {
  return choose(set, baseline::filtering, avx2::filtering, avx512::filtering);
}

const ImplicitKernels& implicit_kernels_for(InstructionSet set) {
  return choose(set, baseline::implicit, avx2::implicit, avx512::implicit);
}

const NewtonKernels& newton_kernels_for(InstructionSet set) {
  return choose(set, baseline::newton, avx2::newton, avx512::newton);
}

}  // namespace weft
