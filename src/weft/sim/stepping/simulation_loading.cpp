// Loading of a simulation's surfaces: cloths, garments and bodies.
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "weft/cloth/cloth.h"
#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/scene_file.h"
#include "weft/sim/flat_rest.h"
#include "weft/sim/panel_starts.h"
#include "weft/sim/placement.h"
#include "weft/sim/stepping/simulation_parts.h"
#include "weft/simulation.h"

namespace weft {
namespace {

constexpr int body_normal_map_size = 257;

}  // namespace

LoadedSurface SurfaceCache::load(const Surface& surface, const ConvertOptions& options) {
  if (surface.in_memory()) return load_surface(surface, options);
  const Key key{surface.name,    options.size,      options.normal_map_size, options.keep_places,
                options.keep_uv, options.keep_warp, options.charts,          options.spacing};
  const auto found = kept_.find(key);
  if (found != kept_.end()) return found->second;
  return kept_.emplace(key, load_surface(surface, options)).first->second;
}
LoadedSurface Simulation::Parts::load(const Surface& surface, ConvertOptions options,
                                      const std::string& what) {
  update(options.progress, "load " + what, 0);
  options.threads = team.size();
  options.keep_source = true;
  options.files = scene.files;
  const auto read = [&] {
    try {
      return surface_cache != nullptr ? surface_cache->load(surface, options)
                                      : load_surface(surface, options);
    } catch (const UsageError& error) {
      // An error of the command line elsewhere; here the surface is named in a scene file.
      throw SceneError(name, fmt::format("'{}': {}", what, error.what()), "");
    }
  };
  LoadedSurface loaded = read();
  for (const std::string& note : loaded.notes) notes.push_back(fmt::format("{}: {}", what, note));
  return loaded;
}

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

Cloth Simulation::Parts::make(const SceneCloth& wanted, const Planes3& placed,
                              const LoadedSurface& loaded) {
  const PlacementMap map = placement_map(wanted.placement);
  const BorderMates& mates = loaded.image.mates;
  try {
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
  } catch (const SceneError& error) {
    throw SceneError(name, fmt::format("'{}': {}", wanted.name, error.what()), "");
  }
}

void Simulation::Parts::check_collider(const char* kind, const BorderMates& mates,
                                       const std::string& what) const {
  if (!Colliders::traits_of(scene.collider).several_charts)
    throw SceneError(
        name, fmt::format("{} '{}' is an image of {} charts", kind, what, mates.charts().size()),
        fmt::format("the collider pyramid is wanted, or a {} of one chart", kind));
}

void Simulation::Parts::check_charts(const BorderMates& mates, const std::string& what) const {
  if (!mates.keep_manifold())
    throw SceneError(
        name,
        fmt::format("cloth '{}' has edges of more than two triangles, or one side only", what),
        "an oriented surface, two triangles at most on every edge, is wanted");
  if (!mates.chart_of().empty() && !Integrators::traits_of(scene.integrator).several_charts)
    throw SceneError(
        name, fmt::format("cloth '{}' is an image of {} charts", what, mates.charts().size()),
        "the integrator newton is wanted, or a cloth of one chart");
  if (!mates.chart_of().empty()) check_collider("cloth", mates, what);
}

namespace {

/// Whether a fabric is not the same along warp and weft.
bool has_direction(const Material& material) {
  return material.stretch.warp != material.stretch.weft ||
         material.bending.warp != material.bending.weft;
}

/// Methods that know one chart only get as few as the mesh can be made of, however poor: others get
/// more where one is stretched.
ChartChoice charts_for(bool several) {
  return several ? ChartChoice::automatic : ChartChoice::pieces;
}

/// What panels keep from the ground at the start. [m]
constexpr double above_ground = 0.01;

}  // namespace

Planes3 Simulation::Parts::place(const SceneCloth& wanted, const LoadedSurface& loaded,
                                 int garment) {
  Planes3 placed = placed_positions(loaded.image, placement_map(wanted.placement));
  if (!loaded.garment) return placed;
  put_round_layers(loaded.image.mates, wanted.layer.value_or(garment), placed);
  // Baselines take the start as it is, and pins and ties are where the pattern puts its panels.
  if (!Colliders::traits_of(scene.collider).containers) return placed;
  if (!wanted.pins.empty() || !wanted.attach.empty()) return placed;
  const double height = scene.ground ? *scene.ground + above_ground : -HUGE_VAL;
  if (const int lifted = lift_above_ground(loaded.image.mates, height, placed))
    notes.push_back(fmt::format("{}: {} of {} panels reached below the ground and begin higher",
                                wanted.name, lifted, loaded.image.mates.charts().size()));
  if (const int moved = move_out_of_bodies(loaded.image, bodies, team, placed))
    notes.push_back(fmt::format("{}: {} of {} panels were in a body and begin farther outside",
                                wanted.name, moved, loaded.image.mates.charts().size()));
  if (const int parted = part_panels(loaded.garment->sewn, placed))
    notes.push_back(fmt::format("{}: {} of {} panels touched others and begin farther outside",
                                wanted.name, parted, loaded.image.mates.charts().size()));
  return placed;
}

BendingPlanes Simulation::Parts::stiffen(SceneCloth wanted, const Planes3& placed,
                                         const LoadedSurface& loaded, Cloth& cloth) {
  wanted.material.bending = Sewing::bending_for(wanted.material);
  return std::exchange(cloth.bending, make(wanted, placed, loaded).bending);
}

void Simulation::Parts::load_cloths() {
  const bool several = Colliders::traits_of(scene.collider).several_charts &&
                       Integrators::traits_of(scene.integrator).several_charts;
  int garments = 0;
  for (const SceneCloth& wanted : scene.cloths) {
    ConvertOptions options;
    options.size = wanted.size;
    options.spacing = wanted.spacing;
    options.keep_uv = wanted.rest.has_value() && !is_image_surface(wanted.surface);
    options.charts = options.keep_uv ? ChartChoice::texture : charts_for(several);
    options.keep_warp = !wanted.rest && has_direction(wanted.material);
    options.progress = progress;
    LoadedSurface loaded = load(wanted.surface, options, wanted.name);
    check_charts(loaded.garment ? loaded.garment->sewn : loaded.image.mates, wanted.name);
    const Planes3 placed = place(wanted, loaded, garments);
    if (loaded.garment) ++garments;
    Cloth cloth = make(wanted, placed, loaded);
    other_bending.push_back(loaded.garment ? stiffen(wanted, placed, loaded, cloth)
                                           : BendingPlanes());
    pin_motions.push_back(pin_places(cloth, wanted.pins));
    ClothState state = rest_state(cloth, vec_cast<float>(wanted.velocity));
    sewing.push_back(loaded.garment
                         ? std::optional<Sewing>(std::in_place, *loaded.garment, state.position)
                         : std::nullopt);
    cloths.push_back({wanted.name, std::move(loaded.image),
                      std::make_shared<Cloth>(std::move(cloth)), std::move(state),
                      std::move(loaded.source), std::move(loaded.garment)});
  }
}

void Simulation::Parts::load_bodies() {
  for (const SceneBody& wanted : scene.bodies) {
    ConvertOptions options;
    options.size = wanted.size;
    options.charts = charts_for(Colliders::traits_of(scene.collider).several_charts);
    options.normal_map_size = body_normal_map_size;
    options.keep_places = !wanted.animation.empty();
    options.progress = progress;
    LoadedSurface loaded = load(wanted.surface, options, wanted.name);
    if (loaded.garment)
      throw SceneError(name, fmt::format("body '{}' is a sewing pattern", wanted.name),
                       "a mesh or a geometry image is wanted");
    if (!loaded.image.has_one_chart()) check_collider("body", loaded.image.mates, wanted.name);
    BodyMotion motion(wanted, loaded, {scene.frame_rate, scene.files});
    const PlacementMap map = placement_map(wanted.placement);
    PlacedBody body;
    body.name = wanted.name;
    body.moves = motion.moves();
    if (loaded.normals && !body.moves) body.normals = placed_normals(*loaded.normals, map);
    body.image_normals = std::move(loaded.normals);
    body.positions = placed_positions(loaded.image, map);
    body.image = std::move(loaded.image);
    body.source = std::move(loaded.source);
    driven.add(std::move(motion));
    bodies.push_back(std::move(body));
  }
  driven.move_to(0, team);
  bodies_arrive();
}

}  // namespace weft
