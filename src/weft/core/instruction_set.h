#pragma once

#include "weft/threads.h"

namespace weft {

/// The variant for an instruction set, of variants compiled for each.
template <class T>
const T& choose(InstructionSet set, const T& baseline, const T& avx2, const T& avx512) {
  if (set == InstructionSet::avx512) return avx512;
  return set == InstructionSet::avx2 ? avx2 : baseline;
}

}  // namespace weft
