#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/sim/scene_file/scene_parts.h"

namespace weft {
namespace {

constexpr int max_passes = 10'000;

/// The `type` of a method, read before its other keys, which depend on it.
std::string type_of(const nlohmann::json& value, const JsonPlace& place,
                    std::string_view fallback) {
  if (!value.is_object()) place.fail("no object", "an object with a \"type\" is wanted");
  const auto at = value.find("type");
  if (at == value.end()) return std::string(fallback);
  if (!at->is_string()) place.key("type").fail("no string", "the name of a method is wanted");
  return at->get<std::string>();
}

void read_option(const JsonObject& object, std::string_view key, bool& value, OptionRange) {
  value = object.boolean(key, value);
}

void read_option(const JsonObject& object, std::string_view key, double& value, OptionRange range) {
  value = object.number(key, value, {range.min, range.max, range.above_min});
}

void read_option(const JsonObject& object, std::string_view key, int& value, OptionRange range) {
  value = object.integer(key, value, static_cast<int>(range.min), static_cast<int>(range.max));
  if (range.odd && value % 2 == 0)
    object.place().key(key).fail(std::to_string(value), "an odd number is wanted");
}

std::string listed(const std::vector<std::string_view>& names) {
  std::string list;
  for (const std::string_view name : names) list.append(list.empty() ? "" : ", ").append(name);
  return list;
}

/// @param kind  "integrator" or the like
template <class Methods>
typename Methods::Variant read_method(const nlohmann::json& value, const JsonPlace& place,
                                      std::string_view kind) {
  const std::string type = type_of(value, place, Methods::names().front());
  auto method = Methods::find(type);
  if (!method)
    place.key("type").fail(fmt::format("unknown {} '{}'", kind, type),
                           "known are: " + listed(Methods::names()));
  std::visit(
      [&]<class Options>(Options& options) {
        const std::vector<std::string_view> keys = scene_keys::of_method<Options>();
        const JsonObject object(value, place, keys);
        Options::visit_options([&](std::string_view key, auto member, OptionRange range) {
          read_option(object, key, options.*member, range);
        });
      },
      *method);
  return *method;
}

}  // namespace

IntegratorOptions read_integrator(const nlohmann::json& value, const JsonPlace& place,
                                  std::optional<int>& limiter_passes) {
  const IntegratorOptions options = read_method<Integrators>(value, place, "integrator");
  if (!Integrators::traits_of(options).has_limiter) return options;
  const std::vector<std::string_view> keys = std::visit(
      []<class Options>(const Options&) { return scene_keys::of_method<Options>(); }, options);
  const JsonObject object(value, place, keys);
  if (object.has(scene_keys::limiter_passes))
    limiter_passes = object.integer(scene_keys::limiter_passes, 0, 0, max_passes);
  return options;
}

ColliderOptions read_collider(const nlohmann::json& value, const JsonPlace& place) {
  return read_method<Colliders>(value, place, "collider");
}

}  // namespace weft
