#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "weft/threads.h"

namespace weft::app {

/// The global options, the same for every command.
struct Context {
  bool json = false;
  bool quiet = false;
  int threads = 1;
  InstructionSet instructions = best_instruction_set();
  std::uint64_t seed = 1;
};

/// Prints a result of a command for people on stdout; nothing with --json or --quiet.
void say(const Context& context, const std::string& line);

/// Prints a remark on stderr, worth reading even with --json; nothing with --quiet.
void note(const Context& context, const std::string& line);

/// Prints a warning in the same way.
void warn(const Context& context, const std::string& line);

/// Prints a line of some kind to stderr; one that cannot be written is lost.
void tell(std::string_view kind, std::string_view line) noexcept;

/// JSON as text; bytes of paths that are not UTF-8 become U+FFFD.
std::string text_of(const nlohmann::ordered_json& report);

/// Prints the command's one JSON object on stdout, with --json only.
void print_report(const Context& context, const nlohmann::ordered_json& report);

}  // namespace weft::app
