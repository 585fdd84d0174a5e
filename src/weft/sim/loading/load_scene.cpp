#include "weft/sim/loading/load_scene.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/image/diagonals.h"
#include "weft/scene_file.h"
#include "weft/shapes.h"
#include "weft/sim/loading/cloth_shape.h"
#include "weft/sim/loading/exits.h"
#include "weft/sim/loading/start_notes.h"
#include "weft/sim/placement.h"
#include "weft/sim/sewing/free_height.h"
#include "weft/sim/sewing/garment_layers.h"
#include "weft/sim/sewing/panel_starts.h"
#include "weft/sim/sewing/rolled_panels.h"

namespace weft {
namespace {

constexpr int body_normal_map_size = 257;

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

/// Loads a scene step by step: first bodies, which the panels of garments must be outside of.
class Loader : public LoadedScene {
 public:
  Loader(const Scene& of, const std::string& scene_name, const SimulationHelp& help,
         ThreadTeam& with)
      : scene_(of),
        name_(scene_name),
        progress_(help.progress),
        surface_cache_(help.surfaces),
        team_(with) {}
  void load_bodies();
  void load_cloths();
  /// Notes bodies from files, and garments, whose unit may be another.
  void compare_sizes();
  /// Ties cloths to bodies, at the initial positions of both.
  void tie_cloths();
  /// Finds the closed bodies that cloths begin inside of, at the initial positions of both.
  void find_insides();

 private:
  void tell(const std::string& name, const std::string& odd);
  LoadedSurface load(const Surface& surface, ConvertOptions options, const std::string& what);
  void check_collider(const char* kind, const BorderMates& mates, const std::string& what) const;
  void check_charts(const BorderMates& mates, const std::string& what) const;
  Cloth make(const SceneCloth& wanted, const Planes3& placed, const LoadedSurface& loaded);
  /// What `made` gives; its errors name the scene and the cloth.
  template <class Made>
  auto of_cloth(const std::string& cloth, const Made& made) const;
  /// Gives a garment the bending of panels that are sewn. @return that of its fabric
  BendingPlanes stiffen(SceneCloth wanted, const Planes3& placed, const LoadedSurface& loaded,
                        Cloth& cloth);
  /// Where the samples of a cloth begin. @param garment  how many garments come before it
  std::vector<GarmentBelow> garments_below(int layer) const;
  Planes3 place(const SceneCloth& wanted, const LoadedSurface& loaded, int garment);

  const Scene& scene_;
  const std::string& name_;
  Progress* progress_;
  SurfaceCache* surface_cache_;  // none: everything is loaded anew
  ThreadTeam& team_;
};

LoadedSurface Loader::load(const Surface& surface, ConvertOptions options,
                           const std::string& what) {
  update(options.progress, "load " + what, 0);
  options.threads = team_.size();
  options.keep_source = true;
  options.files = scene_.files;
  const auto read = [&] {
    try {
      return surface_cache_ != nullptr ? surface_cache_->load(surface, options)
                                       : load_surface(surface, options);
    } catch (const UsageError& error) {
      // An error of the command line elsewhere; here the surface is named in a scene file.
      throw SceneError(name_, fmt::format("'{}': {}", what, error.what()), "");
    }
  };
  LoadedSurface loaded = read();
  for (const std::string& note : loaded.notes) notes.push_back(fmt::format("{}: {}", what, note));
  return loaded;
}

template <class Made>
auto Loader::of_cloth(const std::string& cloth, const Made& made) const {
  try {
    return made();
  } catch (const SceneError& error) {
    throw SceneError(name_, fmt::format("'{}': {}", cloth, error.what()), "");
  }
}

Cloth Loader::make(const SceneCloth& wanted, const Planes3& placed, const LoadedSurface& loaded) {
  return of_cloth(wanted.name, [&] { return cloth_of(wanted, placed, loaded, notes); });
}

void Loader::check_collider(const char* kind, const BorderMates& mates,
                            const std::string& what) const {
  if (!Colliders::traits_of(scene_.collider).several_charts)
    throw SceneError(
        name_, fmt::format("{} '{}' is an image of {} charts", kind, what, mates.charts().size()),
        fmt::format("the collider pyramid is wanted, or a {} of one chart", kind));
}

void Loader::check_charts(const BorderMates& mates, const std::string& what) const {
  if (!mates.keep_manifold())
    throw SceneError(
        name_,
        fmt::format("cloth '{}' has edges of more than two triangles, or one side only", what),
        "an oriented surface, two triangles at most on every edge, is wanted");
  if (!mates.chart_of().empty() && !Integrators::traits_of(scene_.integrator).several_charts)
    throw SceneError(
        name_, fmt::format("cloth '{}' is an image of {} charts", what, mates.charts().size()),
        "the integrator newton is wanted, or a cloth of one chart");
  if (!mates.chart_of().empty()) check_collider("cloth", mates, what);
}

/// The garments that are loaded already and worn below a layer.
std::vector<GarmentBelow> Loader::garments_below(int layer) const {
  std::vector<GarmentBelow> below;
  int garment = 0;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    if (!cloths[i].garment) continue;
    if (const int own = scene_.cloths[i].layer.value_or(garment++); own < layer)
      below.push_back({cloths[i].garment->image.mates, cloths[i].model->start_positions()});
  }
  return below;
}

Planes3 Loader::place(const SceneCloth& wanted, const LoadedSurface& loaded, int garment) {
  Planes3 placed = placed_positions(loaded.image, placement_map(wanted.placement));
  if (!loaded.garment) return placed;
  const int layer = wanted.layer.value_or(garment);
  put_round_layers(loaded.image.mates, layer, garments_below(layer), placed);
  // Baselines take the start as it is, and pins and ties are where the pattern puts its panels.
  if (!Colliders::traits_of(scene_.collider).containers) return placed;
  if (!wanted.pins.empty() || !wanted.attach.empty()) return placed;
  const std::vector<Chart>& panels = loaded.image.mates.charts();
  if (const double up = move_to_free_height(*loaded.garment, bodies, placed); up != 0)
    notes.push_back(fmt::format(
        "{}: begins {:.2g} m {} than its pattern says, where seams have less of a body between "
        "their sides",
        wanted.name, std::abs(up), up > 0 ? "higher" : "lower"));
  const std::vector<char> rolled = roll_up_panels(*loaded.garment, bodies, placed);
  if (const auto count = std::count(rolled.begin(), rolled.end(), 1); count > 0)
    notes.push_back(fmt::format("{}: {} of {} panels are sewn to themselves and begin rolled up",
                                wanted.name, count, panels.size()));
  if (const MovedPanels raised = raise_above_others(*loaded.garment, rolled, placed);
      raised.count > 0)
    notes.push_back(fmt::format(
        "{}: {} of {} panels stand across others that they are sewn to and begin above them, "
        "'{}' by {:.2g} m",
        wanted.name, raised.count, panels.size(), panels[raised.farthest].name, raised.distance));
  const double height = scene_.ground ? *scene_.ground + above_ground : -HUGE_VAL;
  if (const int lifted = lift_above_ground(loaded.image.mates, height, placed))
    notes.push_back(fmt::format("{}: {} of {} panels reached below the ground and begin higher",
                                wanted.name, lifted, panels.size()));
  if (const MovedPanels moved = move_out_of_bodies(loaded.image, bodies, team_, placed);
      moved.count > 0)
    notes.push_back(fmt::format(
        "{}: {} of {} panels were in a body and begin farther outside, '{}' by {:.2g} m",
        wanted.name, moved.count, panels.size(), panels[moved.farthest].name, moved.distance));
  if (const int parted = part_panels(loaded.garment->sewn, placed))
    notes.push_back(fmt::format("{}: {} of {} panels touched others and begin farther outside",
                                wanted.name, parted, panels.size()));
  return placed;
}

BendingPlanes Loader::stiffen(SceneCloth wanted, const Planes3& placed, const LoadedSurface& loaded,
                              Cloth& cloth) {
  wanted.material.bending = Sewing::bending_for(wanted.material);
  return std::exchange(cloth.bending, make(wanted, placed, loaded).bending);
}

void Loader::load_cloths() {
  const bool several = Colliders::traits_of(scene_.collider).several_charts &&
                       Integrators::traits_of(scene_.integrator).several_charts;
  int garments = 0;
  for (const SceneCloth& wanted : scene_.cloths) {
    ConvertOptions options;
    options.size = wanted.size;
    options.spacing = wanted.spacing;
    options.keep_uv = wanted.rest.has_value() && !is_image_surface(wanted.surface);
    options.charts = options.keep_uv ? ChartChoice::texture : charts_for(several);
    options.keep_warp = !wanted.rest && has_direction(wanted.material);
    options.progress = progress_;
    LoadedSurface loaded = load(wanted.surface, options, wanted.name);
    check_charts(loaded.garment ? loaded.garment->sewn : loaded.image.mates, wanted.name);
    const Planes3 placed = place(wanted, loaded, garments);
    const double thickness = wanted.material.thickness;
    for (const std::string& odd : {far_off_text(placed, thickness), thick_text(placed, thickness)})
      tell(wanted.name, odd);
    if (loaded.garment) ++garments;
    Cloth cloth = make(wanted, placed, loaded);
    other_bending.push_back(loaded.garment ? stiffen(wanted, placed, loaded, cloth)
                                           : BendingPlanes());
    gathers.push_back(loaded.garment ? Gathers(cloth) : Gathers());
    if (cloth.start) gathers.back().ripple(cloth, *cloth.start);
    pin_motions.push_back(of_cloth(wanted.name, [&] { return pin_places(cloth, wanted.pins); }));
    ClothState state = rest_state(cloth, vec_cast<float>(wanted.velocity));
    sewing.push_back(loaded.garment
                         ? std::optional<Sewing>(std::in_place, *loaded.garment, state.position)
                         : std::nullopt);
    cloths.push_back({wanted.name, std::move(loaded.image),
                      std::make_shared<Cloth>(std::move(cloth)), std::move(state),
                      std::move(loaded.source), std::move(loaded.garment)});
  }
}

void Loader::load_bodies() {
  for (const SceneBody& wanted : scene_.bodies) {
    ConvertOptions options;
    options.size = wanted.size;
    options.charts = charts_for(Colliders::traits_of(scene_.collider).several_charts);
    options.normal_map_size = body_normal_map_size;
    options.keep_places = !wanted.animation.empty();
    options.progress = progress_;
    LoadedSurface loaded = load(wanted.surface, options, wanted.name);
    if (loaded.garment)
      throw SceneError(name_, fmt::format("body '{}' is a sewing pattern", wanted.name),
                       "a mesh or a geometry image is wanted");
    if (!loaded.image.has_one_chart()) check_collider("body", loaded.image.mates, wanted.name);
    BodyMotion motion(wanted, loaded, {scene_.frame_rate, scene_.files});
    const PlacementMap map = placement_map(wanted.placement);
    PlacedBody body;
    body.name = wanted.name;
    body.moves = motion.moves();
    if (loaded.normals) body.normals = placed_normals(*loaded.normals, map);
    body.image_normals = std::move(loaded.normals);
    body.positions = placed_positions(loaded.image, map);
    if (body.moves) body.placed = body.positions;
    body.image = std::move(loaded.image);
    body.source = std::move(loaded.source);
    driven.add(std::move(motion));
    bodies.push_back(std::move(body));
  }
  driven.move_to(0, team_);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].moves) bodies[i].positions = *driven.ends()[i];
}

/// Notes what is odd about a surface, if anything is.
void Loader::tell(const std::string& name, const std::string& odd) {
  if (!odd.empty()) notes.push_back(fmt::format("{}: {}", name, odd));
}

void Loader::compare_sizes() {
  std::vector<Box3d> boxes;
  for (const SimulatedCloth& cloth : cloths) boxes.push_back(box_of(cloth.state.position));
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!is_builtin(scene_.bodies[i].surface.name))
      tell(bodies[i].name, unlike_text(box_of(bodies[i].positions), boxes));
  std::vector<Box3d> worn_by;
  for (const PlacedBody& body : bodies) worn_by.push_back(box_of(body.positions));
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    if (!cloths[i].garment) continue;
    if (const std::string sizes = unwearable_text(boxes[i], worn_by); !sizes.empty())
      throw SceneError(name_, fmt::format("garment '{}' {}", cloths[i].name, sizes),
                       "a pattern with the units_in_meter that it has is wanted");
    tell(cloths[i].name, unfit_text(boxes[i], worn_by));
  }
}

void Loader::tie_cloths() {
  std::vector<TiedSurface> surfaces;
  for (const PlacedBody& body : bodies)
    surfaces.push_back({body.name, &body.positions, grid_triangles(body.image)});
  for (std::size_t i = 0; i < cloths.size(); ++i)
    tied_pins.push_back(
        tie_places(*cloths[i].model, scene_.cloths[i].attach, surfaces, pin_motions[i]));
  for (const SimulatedCloth& cloth : cloths)
    worn_places.push_back(cloth.garment
                              ? WornPlaces(*cloth.garment, cloth.model->start_positions(), surfaces)
                              : WornPlaces());
}

void Loader::find_insides() {
  for (const SimulatedCloth& cloth : cloths) {
    start_sides.push_back(
        find_start_sides(cloth, bodies, Colliders::traits_of(scene_.collider).containers, team_));
    const std::vector<StartInside>& found = start_sides.back().inside;
    insides.insert(insides.end(), found.begin(), found.end());
    // Baselines take the start as it is.
    if (!Colliders::traits_of(scene_.collider).containers) continue;
    if (const auto torn = find_torn_exit(cloth, bodies, start_sides.back().wrong_side, team_))
      throw SceneError(
          name_,
          fmt::format("cloth '{}' begins in the middle of body '{}': neighbouring points would be "
                      "pushed out by sides of it that are {:.2g} m apart",
                      cloth.name, bodies[torn->body].name, torn->apart),
          "a cloth that begins outside of it, or nearer to its surface, is wanted");
  }
}

}  // namespace

LoadedScene load_scene(const Scene& scene, const std::string& name, const SimulationHelp& help,
                       ThreadTeam& team) {
  Loader loader(scene, name, help, team);
  loader.load_bodies();
  loader.load_cloths();
  loader.compare_sizes();
  loader.tie_cloths();
  loader.find_insides();
  return std::move(static_cast<LoadedScene&>(loader));
}

}  // namespace weft
