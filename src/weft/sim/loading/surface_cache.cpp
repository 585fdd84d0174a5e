#include "weft/simulation.h"

namespace weft {

LoadedSurface SurfaceCache::load(const Surface& surface, const ConvertOptions& options) {
  if (surface.in_memory()) return load_surface(surface, options);
  const Key key{surface.name,        options.size,    options.normal_map_size,
                options.keep_places, options.keep_uv, options.keep_warp,
                options.charts,      options.spacing, options.files.unit.metres,
                options.files.z_up};
  const auto found = kept_.find(key);
  if (found != kept_.end()) return found->second;
  return kept_.emplace(key, load_surface(surface, options)).first->second;
}

}  // namespace weft
