#include "weft/sim/loading/cloth_shape.h"

#include <optional>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/sim/loading/flat_rest.h"
#include "weft/sim/placement.h"

namespace weft {
namespace {

/// A garment of flat panels, their warp along the y axis of the pattern.
Cloth cloth_of_panels(const SceneCloth& wanted, const Planes3& placed, const Garment& garment) {
  if (!(wanted.placement.scale == Vec3d{1, 1, 1}))
    throw SceneError("scale", "a sewing pattern of another size", "1 is wanted");
  const Planes3 warp = even_warp(garment.flat.size(), {0, 1, 0});
  const BorderMates& apart = garment.image.mates;
  Cloth cloth = make_cloth({garment.flat, garment.sewn, &apart, &warp}, wanted.material);
  cloth.apart = apart;
  cloth.start = placed;
  return cloth;
}

/// A mesh whose rest shape is its texture.
Cloth cloth_of_texture(const SceneCloth& wanted, const Planes3& placed, const FlatRest& flat,
                       const BorderMates& mates) {
  Cloth cloth = make_cloth({flat.rest, mates, &flat.bent, &flat.warp}, wanted.material);
  cloth.start = placed;
  return cloth;
}

/// The direction of the warp in the world; only lengths are lost.
Planes3 placed_warp(const Planes3& warp, const PlacementMap& map) {
  Planes3 placed(warp.size());
  for (int s = 0; s < warp.size() * warp.size(); ++s) {
    const Vec3d along = vec_cast<double>(warp.at(s));
    placed.set(s, vec_cast<float>(map.point(along) - map.translate));
  }
  return placed;
}

}  // namespace

Cloth cloth_of(const SceneCloth& wanted, const Planes3& placed, const LoadedSurface& loaded,
               std::vector<std::string>& notes) {
  const PlacementMap map = placement_map(wanted.placement);
  const BorderMates& mates = loaded.image.mates;
  if (loaded.garment && !wanted.rest) return cloth_of_panels(wanted, placed, *loaded.garment);
  if (wanted.rest && !loaded.texture)
    throw SceneError("rest", "uv of what has no texture coordinates",
                     "a mesh file with texture coordinates is wanted");
  if (wanted.rest) {
    const FlatRest flat = flat_rest(loaded, map, *wanted.rest);
    if (!wanted.rest->scale)
      notes.push_back(fmt::format("{}: uv_scale {:.6g} m gives the texture the mesh's area",
                                  wanted.name, flat.scale));
    return cloth_of_texture(wanted, placed, flat, mates);
  }
  const std::optional<Planes3> warp =
      loaded.warp ? std::optional(placed_warp(*loaded.warp, map)) : std::nullopt;
  return make_cloth({placed, mates, nullptr, warp ? &*warp : nullptr}, wanted.material);
}

}  // namespace weft
