// Apart from the colliders, so that reading a scene does not bring them along.
#include "weft/collide/collider.h"

namespace weft {

std::string_view name_of(const ColliderOptions& options) {
  return std::holds_alternative<PyramidOptions>(options) ? "pyramid" : "polar_map";
}
bool knows_self_collision(const ColliderOptions& options) {
  return std::holds_alternative<PyramidOptions>(options);
}

bool knows_moving_bodies(const ColliderOptions& options) {
  return std::holds_alternative<PyramidOptions>(options);
}

}  // namespace weft
