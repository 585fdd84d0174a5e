// Construction of a simulation: surfaces, attachments, movers and the collider.
#include <algorithm>

#include <fmt/format.h>

#include "weft/cloth/cloth.h"
#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/image/diagonals.h"
#include "weft/scene_file.h"
#include "weft/sim/exits.h"
#include "weft/sim/flat_rest.h"
#include "weft/sim/placement.h"
#include "weft/sim/stepping/simulation_parts.h"
#include "weft/simulation.h"

namespace weft {

LoadedSurface SurfaceCache::load(const Surface& surface, const ConvertOptions& options) {
  if (surface.in_memory()) return load_surface(surface, options);
  const Key key{surface.name,    options.size,      options.normal_map_size, options.keep_places,
                options.keep_uv, options.keep_warp, options.charts,          options.spacing};
  const auto found = kept_.find(key);
  if (found != kept_.end()) return found->second;
  return kept_.emplace(key, load_surface(surface, options)).first->second;
}
namespace {

constexpr int body_normal_map_size = 257;
/// The gap grows from the thickness of the fabric to this part of the cloth's rest spacing, so that
/// the gentle curvature of a body does not show through between two samples, but to no more than a
/// few thicknesses, or coarse cloths would float.
constexpr double gap_in_spacings = 1.0 / 3, max_gap_in_thicknesses = 3;

/// Largest gap between parts of cloth, in rest spacings; a larger one would lock folds.
constexpr double max_self_gap_in_spacings = 0.25;

/// Part of a cloth that may begin exactly on another one: a few rows find their way apart.
constexpr double max_part_in_one_place = 0.05;

/// Friction coefficient of the ground, which scenes do not set.
constexpr double ground_friction = 0.5;

}  // namespace

double self_gap_of(const Cloth& cloth) {
  return std::min(cloth.material.thickness, max_self_gap_in_spacings * cloth.rest_spacing);
}

double gap_of(const Cloth& cloth) {
  const double thickness = cloth.material.thickness;
  return std::clamp(gap_in_spacings * cloth.rest_spacing, thickness,
                    max_gap_in_thicknesses * thickness);
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

/// How much farther outside the panels of a garment start than those of the one below it. [m]
constexpr double layer_distance = 0.05;

/// The outer side of a chart, on the mean.
Vec3d outer_side(const Chart& chart, const Planes3& placed) {
  Vec3d sum;
  for (int r = chart.row; r + 1 < chart.row + chart.rows; ++r)
    for (int c = chart.col; c + 1 < chart.col + chart.cols; ++c) {
      const Vec3d along = vec_cast<double>(placed.at(r + 1, c + 1) - placed.at(r, c));
      const Vec3d across = vec_cast<double>(placed.at(r + 1, c) - placed.at(r, c + 1));
      sum += cross(along, across);
    }
  return normalized(sum);
}

/// Moves the panels of a garment outwards, so that it closes round those that are worn below it.
void push_out(const BorderMates& mates, int layer, Planes3& placed) {
  std::vector<Vec3f> shift;
  for (const Chart& chart : mates.charts())
    shift.push_back(vec_cast<float>(layer * layer_distance * outer_side(chart, placed)));
  const std::vector<int>& chart_of = mates.chart_of();
  for (int s = 0; s < placed.size() * placed.size(); ++s) {
    const int at = mates.is_hole(s) ? mates.representative(s) : s;
    placed.set(s, placed.at(s) + shift[chart_of.empty() ? 0 : chart_of[at]]);
  }
}

/// Whether a fabric is not the same along warp and weft.
bool has_direction(const Material& material) {
  return material.stretch.warp != material.stretch.weft ||
         material.bending.warp != material.bending.weft;
}

}  // namespace

void Simulation::Parts::load_cloths() {
  int garments = 0;
  for (const SceneCloth& wanted : scene.cloths) {
    ConvertOptions options;
    options.size = wanted.size;
    options.spacing = wanted.spacing;
    options.keep_uv = wanted.rest.has_value() && !is_image_surface(wanted.surface);
    if (options.keep_uv) options.charts = ChartChoice::texture;
    options.keep_warp = !wanted.rest && has_direction(wanted.material);
    options.progress = progress;
    LoadedSurface loaded = load(wanted.surface, options, wanted.name);
    check_charts(loaded.garment ? loaded.garment->sewn : loaded.image.mates, wanted.name);
    Planes3 placed = placed_positions(loaded.image, placement_map(wanted.placement));
    if (loaded.garment) push_out(loaded.image.mates, wanted.layer.value_or(garments++), placed);
    Cloth cloth = make(wanted, placed, loaded);
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
    body_triangles.push_back(body.moves ? joined_triangles(body.image) : std::vector<Triangle>());
    body.source = std::move(loaded.source);
    driven.add(std::move(motion));
    bodies.push_back(std::move(body));
  }
  driven.move_to(0, team);
  bodies_arrive();
}

void Simulation::Parts::tie_cloths() {
  std::vector<TiedSurface> surfaces;
  for (const PlacedBody& body : bodies)
    surfaces.push_back({body.name, &body.positions, grid_triangles(body.image)});
  for (std::size_t i = 0; i < cloths.size(); ++i)
    tied_pins.push_back(
        tie_places(*cloths[i].model, scene.cloths[i].attach, surfaces, pin_motions[i]));
}

void Simulation::Parts::find_insides() {
  for (const SimulatedCloth& cloth : cloths) {
    start_sides.push_back(
        find_start_sides(cloth, bodies, Colliders::traits_of(scene.collider).containers, team));
    const std::vector<StartInside>& found = start_sides.back().inside;
    insides.insert(insides.end(), found.begin(), found.end());
    // Baselines take the start as it is.
    if (!Colliders::traits_of(scene.collider).containers) continue;
    if (const auto torn = find_torn_exit(cloth, bodies, start_sides.back().wrong_side, team))
      throw SceneError(
          name,
          fmt::format("cloth '{}' begins in the middle of body '{}': neighbouring points would be "
                      "pushed out by sides of it that are {:.2g} m apart",
                      cloth.name, bodies[torn->body].name, torn->apart),
          "a cloth that begins outside of it, or nearer to its surface, is wanted");
  }
}

void Simulation::Parts::check_apart() {
  // Baselines take the start as it is.
  if (cloths.size() < 2 || !Colliders::traits_of(scene.collider).filters) return;
  make_check();
  for (std::size_t j = 1; j < cloths.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const double part = std::max(check->part_lying_on(i, j), check->part_lying_on(j, i));
      if (part <= max_part_in_one_place) continue;
      const double gap = self_gap_of(*cloths[i].model) + self_gap_of(*cloths[j].model);
      throw SceneError(
          name,
          fmt::format("cloths '{}' and '{}' begin in the same place: {:.0f} % of one lies exactly "
                      "on the other, and which is above nobody can tell",
                      cloths[i].name, cloths[j].name, 100 * part),
          fmt::format("cloths that begin {:.2g} m apart, or more, are wanted", gap / 2));
    }
}

void Simulation::Parts::make_collider_of_scene() {
  Obstacles obstacles;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    obstacles.bodies.push_back({bodies[i].positions, bodies[i].image.mates,
                                scene.bodies[i].friction, choose_diagonals(bodies[i].image)});
    if (bodies[i].moves)
      obstacles.bodies.back().shape =
          placed_positions(bodies[i].image, placement_map(scene.bodies[i].placement));
  }
  obstacles.ground = scene.ground;
  obstacles.ground_friction = ground_friction;
  std::vector<CollidingCloth> colliding;
  max_approach_in_step = HUGE_VAL;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    const SimulatedCloth& cloth = cloths[i];
    max_approach_in_step =
        std::min(max_approach_in_step, max_approach_in_gaps * gap_of(*cloth.model));
    // Seams slide over what is between them.
    const double friction = cloth.model->apart ? 0 : scene.cloths[i].friction;
    colliding.push_back({cloth.model->together(), cloth.model->size, choose_diagonals(cloth.image),
                         gap_of(*cloth.model), friction, cloth.model->rest_spacing,
                         Colliders::traits_of(scene.collider).self_collision &&
                             scene.cloths[i].self_collision.value_or(true),
                         self_gap_of(*cloth.model), &cloth.model->rest, start_sides[i].kept_in,
                         start_sides[i].wrong_side,
                         cloth.model->apart ? &cloth.model->mates : nullptr});
  }
  collider = make_collider(scene.collider, obstacles, colliding);
  collider->share_contacts(joint != nullptr);
}

void Simulation::Parts::make_check() {
  for (const SimulatedCloth& cloth : cloths)
    checked_triangles.push_back(joined_triangles(cloth.image));
  for (const PlacedBody& body : bodies) checked_triangles.push_back(joined_triangles(body.image));
  std::vector<GridTriangles> checked_cloths, checked_bodies;
  auto triangles = checked_triangles.cbegin();
  for (const SimulatedCloth& cloth : cloths)
    checked_cloths.push_back(
        {&cloth.state.position, &*triangles++, cloth.garment ? &cloth.garment->sewn : nullptr});
  for (const PlacedBody& body : bodies) checked_bodies.push_back({&body.positions, &*triangles++});
  check.emplace(checked_cloths, checked_bodies, scene.ground);
}

void Simulation::Parts::note_too_fast() {
  if (driven.fastest() * substep_time <= max_pieces * max_approach_in_step) return;
  notes.push_back(fmt::format(
      "bodies go up to {:.4g} m/s, faster than cloth can be kept from them; {} substeps "
      "or more are wanted",
      driven.fastest(),
      std::ceil(driven.fastest() / (scene.frame_rate * max_pieces * max_approach_in_step))));
}

void Simulation::Parts::make_movers() {
  const StepInput typical{time_step, vec_cast<float>(scene.gravity)};
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    const SimulatedCloth& cloth = cloths[i];
    movers.push_back(
        {make_integrator(scene.integrator, *cloth.model, typical, solvers()),
         scene.wind ? std::optional<Wind>(std::in_place, *scene.wind, *cloth.model) : std::nullopt,
         RunawayCheck(*cloth.model, cloth.state, scene.gravity, drive_of(i)),
         StrainLimit(*cloth.model, solvers()),
         soft ? std::optional<CoarseLimit>(std::in_place, *cloth.model, solvers()) : std::nullopt,
         EnergyMeter(*cloth.model, scene.gravity, solvers(), stiffens()),
         DrivenWork(*cloth.model, scene.gravity, solvers(), stiffens()), Energy{}, Energy{},
         Energy{}, Planes3(scene.wind || cloth.garment ? cloth.model->size : 0),
         Planes3(cloth.model->size)});
    if (const std::string caution = movers.back().integrator->caution(); !caution.empty())
      notes.push_back(fmt::format("{}: {}", cloth.name, caution));
  }
  std::vector<Integrator*> all;
  for (const Mover& mover : movers) all.push_back(mover.integrator.get());
  if (all.size() > 1) joint = all.front()->join(all, team);
  own_contacts.reserve(cloths.size());
  moving.reserve(cloths.size());
  int largest = min_image_size;
  for (const SimulatedCloth& cloth : cloths) largest = std::max(largest, cloth.model->size);
  reach = ClothReach(largest);
  for (std::size_t i = 0; i < cloths.size(); ++i)
    start_energy += movers[i].meter.measure(cloths[i].state);
}

double Simulation::Parts::drive_of(std::size_t index) const {
  return (scene.wind ? length(scene.wind->velocity) : 0) +
         std::max(fastest_pin(pin_motions[index]), driven.fastest());
}

}  // namespace weft
