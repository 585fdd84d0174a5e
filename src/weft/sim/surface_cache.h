#pragma once

#include <compare>
#include <map>
#include <string>

#include "weft/convert/convert.h"
#include "weft/convert/load_surface.h"

namespace weft {

/// Keeps surfaces that were loaded, for those who make a scene's simulation again and again: what
/// took seconds to convert is there at once the next time. Files that changed since are not looked
/// at again.
class SurfaceCache {
 public:
  /// As load_surface. @throws as it
  LoadedSurface load(const std::string& name, const ConvertOptions& options);
  void clear() { kept_.clear(); }

 private:
  /// What of the options scenes set.
  struct Key {
    std::string name;
    int size = 0, normal_map_size = 0;
    bool keep_places = false;
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  std::map<Key, LoadedSurface> kept_;
};

}  // namespace weft
