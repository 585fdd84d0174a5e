#include "weft/core/json.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace weft {

std::string json_text(const nlohmann::json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string json_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

namespace {

using Json = nlohmann::json;

int line_of(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte > 0 ? byte - 1 : 0);
  return 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
}

/// The position where the nesting first exceeds `deepest`; npos when it never does. Checked before
/// parsing, since the parser's memory grows with every level.
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

/// Input iterator that records how far the text was read, since the parser does not tell at keys.
class ReadAlong {
 public:
  // The names that the standard asks for. NOLINTBEGIN(readability-identifier-naming)
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  // NOLINTEND(readability-identifier-naming)

  ReadAlong(const char* at, const char** furthest) : at_(at), furthest_(furthest) {}
  reference operator*() const { return *at_; }
  ReadAlong& operator++() {
    *furthest_ = ++at_;
    return *this;
  }
  bool operator==(const ReadAlong& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  const char** furthest_;
};

/// Parses JSON and refuses repeated keys, of which the JSON library silently keeps the last.
Json parse_with_keys_once(std::string_view text) {
  const char* at = text.data();
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto watch = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value).second)
      throw JsonFault(fmt::format("the key '{}' is there twice", value.get<std::string>()),
                      line_of(text, static_cast<std::size_t>(at - text.data())),
                      "each key once is wanted");
    return true;
  };
  const char* const end = text.data() + text.size();
  return Json::parse(ReadAlong(text.data(), &at), ReadAlong(end, &at), watch);
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
    return parse_with_keys_once(text);
  } catch (const Json::parse_error& error) {
    throw JsonFault("is not JSON here", line_of(text, error.byte));
  } catch (const Json::out_of_range&) {
    throw JsonFault("a number that doubles cannot hold", 0);
  }
}

}  // namespace weft
