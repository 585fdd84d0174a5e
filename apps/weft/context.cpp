#include "apps/weft/context.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace weft::app {

void say(const Context& context, const std::string& line) {
  if (!context.json && !context.quiet) fmt::print("{}\n", line);
}

void note(const Context& context, const std::string& line) {
  if (!context.quiet) fmt::print(stderr, "weft: note: {}\n", line);
}

void print_report(const Context& context, const nlohmann::ordered_json& report) {
  if (context.json) fmt::print("{}\n", report.dump(2));
}

}  // namespace weft::app
