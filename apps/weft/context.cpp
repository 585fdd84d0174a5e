#include "apps/weft/context.h"

#include <cstdio>
#include <system_error>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "weft/error.h"

namespace weft::app {
namespace {

void put(const std::string& text) {
  try {
    fmt::print("{}\n", text);
  } catch (const std::system_error& error) {
    throw OutputError("stdout", "cannot be written: " + error.code().message(),
                      "a standard output with room is wanted");
  }
}

}  // namespace

void say(const Context& context, const std::string& line) {
  if (!context.json && !context.quiet) put(line);
}

void note(const Context& context, const std::string& line) {
  if (!context.quiet) tell("note", line);
}

void warn(const Context& context, const std::string& line) {
  if (!context.quiet) tell("warning", line);
}

void tell(std::string_view kind, std::string_view line) noexcept {
  for (const std::string_view text :
       {std::string_view("weft: "), kind, std::string_view(": "), line, std::string_view("\n")})
    std::fwrite(text.data(), 1, text.size(), stderr);
}

std::string text_of(const nlohmann::ordered_json& report) {
  // Paths may hold bytes that are no UTF-8.
  return report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

void print_report(const Context& context, const nlohmann::ordered_json& report) {
  if (context.json) put(text_of(report));
}

}  // namespace weft::app
