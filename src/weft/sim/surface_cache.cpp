#include "weft/sim/surface_cache.h"

namespace weft {

LoadedSurface SurfaceCache::load(const std::string& name, const ConvertOptions& options) {
  const Key key{name, options.size, options.normal_map_size, options.keep_places};
  const auto found = kept_.find(key);
  if (found != kept_.end()) return found->second;
  return kept_.emplace(key, load_surface(name, options)).first->second;
}

}  // namespace weft
