#include "weft/core/instruction_set.h"

#include <array>

namespace weft {
namespace {

constexpr std::array<InstructionSet, 3> sets{InstructionSet::baseline, InstructionSet::avx2,
                                             InstructionSet::avx512};
constexpr std::array<std::string_view, 3> names{"baseline", "avx2", "avx512"};

}  // namespace

std::span<const InstructionSet> instruction_sets() { return sets; }

std::string_view name_of(InstructionSet set) { return names[static_cast<std::size_t>(set)]; }

std::optional<InstructionSet> find_instruction_set(std::string_view name) {
  for (const InstructionSet set : sets)
    if (name_of(set) == name) return set;
  return std::nullopt;
}

bool has_instruction_set(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2") != 0;
  if (set == InstructionSet::avx512)
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
           __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512bw") != 0;
#endif
  return set == InstructionSet::baseline;
}

InstructionSet best_instruction_set() {
  InstructionSet best = InstructionSet::baseline;
  for (const InstructionSet set : sets)
    if (has_instruction_set(set)) best = set;
  return best;
}

}  // namespace weft
