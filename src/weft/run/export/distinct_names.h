#pragma once

#include <set>
#include <string>
#include <utility>

namespace weft {

/// Names of a file's parts, no two of them alike, and the same in files of every format: one word
/// each, as groups of OBJ files are, and no path, which unpacking an archive would follow.
class DistinctNames {
 public:
  /// The name with `_` for each character that has to go, and a number after it where it is taken.
  std::string add(std::string name) {
    for (char& c : name)
      if (static_cast<unsigned char>(c) <= ' ' || c == '/' || c == '\\') c = '_';
    const std::string plain = name;
    for (int k = 2; !taken_.insert(name).second; ++k) name = plain + '_' + std::to_string(k);
    return name;
  }

 private:
  std::set<std::string> taken_;
};

}  // namespace weft
