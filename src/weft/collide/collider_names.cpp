// Apart from the colliders, so that reading a scene does not bring them along.
#include <array>

#include "weft/collide/collider.h"

namespace weft {
namespace {

/// In the order of the variant.
constexpr std::array<std::string_view, std::variant_size_v<ColliderOptions>> names{
    "pyramid", "polar_map", "sphere_tree", "spatial_hash", "image_space"};

}  // namespace

std::string_view name_of(const ColliderOptions& options) { return names[options.index()]; }

std::optional<ColliderOptions> collider_named(std::string_view name) {
  const std::array<ColliderOptions, names.size()> all{PyramidOptions{}, PolarMapOptions{},
                                                      SphereTreeOptions{}, SpatialHashOptions{},
                                                      ImageSpaceOptions{}};
  for (const ColliderOptions& options : all)
    if (name == name_of(options)) return options;
  return std::nullopt;
}

bool knows_self_collision(const ColliderOptions& options) {
  return !std::holds_alternative<PolarMapOptions>(options);
}

bool knows_containers(const ColliderOptions& options) {
  return !std::holds_alternative<PolarMapOptions>(options);
}

bool knows_moving_bodies(const ColliderOptions& options) {
  return !std::holds_alternative<PolarMapOptions>(options);
}

}  // namespace weft
