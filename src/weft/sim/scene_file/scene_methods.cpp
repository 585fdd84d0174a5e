#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/sim/scene_file/scene_keys.h"
#include "weft/sim/scene_file/scene_parts.h"

namespace weft {
namespace {

constexpr int max_iterations = 1'000'000;
constexpr int max_passes = 10'000;
constexpr int largest_table = 8193;

/// The `type` of a method, looked at before its other keys, which depend on it.
std::string type_of(const nlohmann::json& value, const JsonPlace& place,
                    std::string_view fallback) {
  if (!value.is_object()) place.fail("no object", "an object with a \"type\" is wanted");
  const auto at = value.find("type");
  if (at == value.end()) return std::string(fallback);
  if (!at->is_string()) place.key("type").fail("no string", "the name of a method is wanted");
  return at->get<std::string>();
}

/// Of the methods that iterate to a tolerance.
template <class Options>
Options read_iterative(const JsonObject& object) {
  Options options;
  options.max_iterations =
      object.integer("max_iterations", options.max_iterations, 1, max_iterations);
  options.tolerance = object.number("tolerance", options.tolerance, positive);
  return options;
}

TwoLevelOptions read_two_level(const JsonObject& object) {
  TwoLevelOptions options;
  options.local_size = object.integer("local_size", options.local_size, 3, largest_image_size);
  if (options.local_size % 2 == 0)
    object.place()
        .key("local_size")
        .fail(fmt::format("{}", options.local_size), "an odd number is wanted");
  options.global_size = object.integer("global_size", options.global_size, 0, largest_image_size);
  options.as_printed = object.boolean("as_printed", options.as_printed);
  options.filter_stiffness =
      object.number("filter_stiffness", options.filter_stiffness, not_negative);
  return options;
}

std::optional<int> read_passes(const JsonObject& object) {
  if (!object.has("limiter_passes")) return std::nullopt;
  return object.integer("limiter_passes", 0, 0, max_passes);
}

}  // namespace

IntegratorOptions read_integrator(const nlohmann::json& value, const JsonPlace& place,
                                  std::optional<int>& limiter_passes) {
  const std::string type = type_of(value, place, name_of(IntegratorOptions{}));
  const auto read = [&](std::span<const std::string_view> keys,
                        const auto& options_of) -> IntegratorOptions {
    const JsonObject object(value, place, keys);
    limiter_passes = read_passes(object);
    return options_of(object);
  };
  if (type == name_of(NewtonOptions{}))
    return read(scene_keys::newton_integrator, read_iterative<NewtonOptions>);
  if (type == name_of(ImplicitOptions{}))
    return read(scene_keys::implicit_integrator, read_iterative<ImplicitOptions>);
  if (type == name_of(MultigridOptions{}))
    return read(scene_keys::multigrid_integrator, read_iterative<MultigridOptions>);
  if (type == name_of(TwoLevelOptions{}))
    return read(scene_keys::two_level_integrator, read_two_level);
  if (type == name_of(ExplicitOptions{}))
    return read(scene_keys::explicit_integrator,
                [](const JsonObject&) { return ExplicitOptions{}; });
  if (type == name_of(DesbrunOptions{}))
    return read(scene_keys::desbrun_integrator, [](const JsonObject&) { return DesbrunOptions{}; });
  place.key("type").fail(fmt::format("unknown integrator '{}'", type),
                         "known are: newton, implicit, explicit, desbrun, two_level, multigrid");
}

ColliderOptions read_collider(const nlohmann::json& value, const JsonPlace& place) {
  const std::string type = type_of(value, place, name_of(ColliderOptions{}));
  const std::optional<ColliderOptions> named = collider_named(type);
  if (!named)
    place.key("type").fail(fmt::format("unknown collider '{}'", type),
                           "known are: pyramid, polar_map, sphere_tree, spatial_hash, image_space");
  if (!std::holds_alternative<PolarMapOptions>(*named)) {
    const JsonObject object(value, place, scene_keys::pipeline_collider);
    return *named;
  }
  const JsonObject object(value, place, scene_keys::polar_map_collider);
  PolarMapOptions options;
  options.size = object.integer("size", options.size, 0, largest_table);
  options.walk = object.boolean("walk", options.walk);
  return options;
}

}  // namespace weft
