#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json_fwd.hpp>

namespace weft {

/// JSON as text. Compiled once here, since the JSON library's writer is slow to compile.
/// @param indent  spaces a level; -1: all in one line. Bytes that are no UTF-8, as paths may hold,
/// are replaced.
std::string json_text(const nlohmann::json& json, int indent = -1);
std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

/// A fault in a JSON text: its description and line. Callers turn it into an error of their own.
class JsonFault : public std::runtime_error {
 public:
  /// @param line  from 1; 0 where it is not known
  /// @param wanted  what is wanted instead, where that is more than JSON
  JsonFault(const std::string& found, int line, std::string wanted = {})
      : std::runtime_error(found), line_(line), wanted_(std::move(wanted)) {}
  /// FILE:LINE, or FILE alone.
  [[nodiscard]] std::string place(std::string_view file) const;
  /// @param otherwise  what the caller wants, for faults that do not say
  [[nodiscard]] std::string_view wanted(std::string_view otherwise) const {
    return wanted_.empty() ? otherwise : wanted_;
  }

 private:
  int line_;
  std::string wanted_;
};

/// Parses JSON that is not trusted.
/// @param deepest  maximum nesting of lists and objects: writing JSON recurses, so the depth of
///                 input must be bounded
/// @throws JsonFault for what is not JSON, nested deeper, a key that an object holds twice, or a
/// number that doubles cannot hold
nlohmann::json parse_json(std::string_view text, int deepest);

}  // namespace weft
