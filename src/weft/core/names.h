#pragma once

#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// Letters of ASCII in lower case; other bytes as they are.
inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

/// Number of letters to insert, delete or replace to turn one word into the other (Levenshtein
/// 1966).
int edit_distance(std::string_view a, std::string_view b);

/// The candidate with the smallest edit distance to `name`, the first of several; empty when there
/// is no candidate. For errors that suggest what was meant.
std::string nearest_name(std::string_view name, const std::vector<std::string_view>& candidates);

}  // namespace weft
