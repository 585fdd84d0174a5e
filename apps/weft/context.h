#pragma once

#include <cstdint>
#include <string>

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

/// What a command found, for people, on stdout; nothing with --json or --quiet.
void say(const Context& context, const std::string& line);

/// A remark that is worth reading even with --json: on stderr; nothing with --quiet.
void note(const Context& context, const std::string& line);

/// The same for what may not be as the user thinks.
void warn(const Context& context, const std::string& line);

/// JSON as text; bytes of paths that are not UTF-8 become U+FFFD.
std::string text_of(const nlohmann::ordered_json& report);

/// The command's one JSON object on stdout, with --json only.
void print_report(const Context& context, const nlohmann::ordered_json& report);

}  // namespace weft::app
