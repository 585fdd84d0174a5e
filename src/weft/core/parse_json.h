#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace weft {

/// What is wrong with a JSON text, in words, and in which line. Callers make it an error of their
/// own.
class JsonFault : public std::runtime_error {
 public:
  /// @param line  from 1; 0 where it is not known
  JsonFault(const std::string& found, int line) : std::runtime_error(found), line_(line) {}
  /// FILE:LINE, or FILE alone.
  [[nodiscard]] std::string place(std::string_view file) const;

 private:
  int line_;
};

/// Parses JSON that is not trusted.
/// @param deepest  how many lists and objects may lie inside each other: writing JSON out again
///                 recurses, so that depth has to be bounded where text comes in
/// @throws JsonFault for what is not JSON, nested deeper, or a number that doubles cannot hold
nlohmann::json parse_json(std::string_view text, int deepest);

}  // namespace weft
