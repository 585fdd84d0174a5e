#include "weft/core/parse_json.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace weft {
namespace {

using Json = nlohmann::json;

int line_of(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte > 0 ? byte - 1 : 0);
  return 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
}

/// Where the nesting first exceeds `deepest`; npos when it never does. Before the parser sees the
/// text, which grows with every level.
std::size_t too_deep_at(std::string_view text, int deepest) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (in_text && c == '\\') ++at;
    if (c == '"') in_text = !in_text;
    if (in_text) continue;
    if ((c == '[' || c == '{') && ++depth > deepest) return at;
    if (c == ']' || c == '}') --depth;
  }
  return text.npos;
}

}  // namespace

std::string JsonFault::place(std::string_view file) const {
  return line_ > 0 ? fmt::format("{}:{}", file, line_) : std::string(file);
}

Json parse_json(std::string_view text, int deepest) {
  const std::size_t deep = too_deep_at(text, deepest);
  if (deep != text.npos)
    throw JsonFault(fmt::format("JSON nested more than {} deep", deepest), line_of(text, deep + 1));
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw JsonFault("is not JSON here", line_of(text, error.byte));
  } catch (const Json::out_of_range&) {
    throw JsonFault("a number that doubles cannot hold", 0);
  }
}

}  // namespace weft
