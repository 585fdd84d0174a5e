#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace weft {

/// Instruction sets that the inner loops are compiled for. All give the same bits and differ in
/// speed alone.
enum class InstructionSet {
  baseline,  ///< every x86-64 processor
  avx2,
  avx512,  ///< F, VL, DQ and BW
};

/// All instruction sets, from narrow to wide.
std::span<const InstructionSet> instruction_sets();
/// The name on the command line: baseline, avx2, avx512.
std::string_view name_of(InstructionSet set);
std::optional<InstructionSet> find_instruction_set(std::string_view name);

/// Whether this processor has it.
bool has_instruction_set(InstructionSet set);
/// The widest that this processor has.
InstructionSet best_instruction_set();

/// Size and instruction set of a thread team.
struct TeamOptions {
  int size = 1;  ///< threads, >= 1
  /// Of the inner loops; this processor must have it.
  InstructionSet instructions = best_instruction_set();

  TeamOptions(int threads,  // NOLINT(google-explicit-constructor): most say no more
              InstructionSet set = best_instruction_set())
      : size(threads), instructions(set) {}
};

}  // namespace weft
