#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace weft {

/// What the inner loops are compiled for. All give the same bits: they differ in speed alone.
enum class InstructionSet {
  baseline,  ///< every x86-64 processor
  avx2,
  avx512,  ///< F, VL, DQ and BW
};

/// From narrow to wide.
std::span<const InstructionSet> instruction_sets();
/// The name on the command line: baseline, avx2, avx512.
std::string_view name_of(InstructionSet set);
std::optional<InstructionSet> find_instruction_set(std::string_view name);

/// Whether this processor has it.
bool has_instruction_set(InstructionSet set);
/// The widest that this processor has.
InstructionSet best_instruction_set();

/// What was compiled for a set, of what was compiled for each.
template <class T>
const T& choose(InstructionSet set, const T& baseline, const T& avx2, const T& avx512) {
  if (set == InstructionSet::avx512) return avx512;
  return set == InstructionSet::avx2 ? avx2 : baseline;
}

}  // namespace weft
