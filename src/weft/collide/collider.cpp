#include "weft/collide/collider.h"

namespace weft {

std::unique_ptr<Collider> make_collider(const ColliderOptions& options, const Obstacles& obstacles,
                                        std::span<const CollidingCloth> cloths) {
  return std::visit([&](const auto& chosen) { return make_collider_of(chosen, obstacles, cloths); },
                    options);
}

}  // namespace weft
