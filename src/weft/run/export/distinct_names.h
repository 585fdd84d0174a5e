#pragma once

#include <set>
#include <string>
#include <utility>

namespace weft {

/// Names of a file's parts, no two of them alike.
class DistinctNames {
 public:
  /// The name with `_` for each character that has to go, and a number after it where it is taken.
  /// @param unwanted  bool(char)
  template <class Unwanted>
  std::string add(std::string name, Unwanted unwanted) {
    for (char& c : name)
      if (unwanted(c)) c = '_';
    const std::string plain = name;
    for (int k = 2; !taken_.insert(name).second; ++k) name = plain + '_' + std::to_string(k);
    return name;
  }

 private:
  std::set<std::string> taken_;
};

}  // namespace weft
