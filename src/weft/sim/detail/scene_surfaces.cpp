#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/core/nearest_name.h"
#include "weft/sim/detail/scene_parts.h"
#include "weft/sim/materials.h"
#include "weft/sim/scene_keys.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr NumberRange friction_range{0, 10, false};

std::string resolved(const std::string& surface, const fs::path& folder) {
  if (surface.starts_with("builtin:")) return surface;
  return fs::absolute(folder / surface).lexically_normal().string();
}

/// A number for all three axes, or three.
Vec3d read_scale(const JsonObject& object) {
  const nlohmann::json* value = object.find("scale");
  const JsonPlace place = object.place().key("scale");
  Vec3d scale{1, 1, 1};
  if (value != nullptr && value->is_number()) {
    const double all = object.number("scale", 1, positive);
    scale = {all, all, all};
  } else {
    scale = object.vector("scale", scale);
  }
  if (!(scale.x > 0 && scale.y > 0 && scale.z > 0))
    place.fail("a scale that is not positive", "a number > 0, or three of them, is wanted");
  return scale;
}

Placement read_placement(const JsonObject& object) {
  return {read_scale(object), object.vector("rotate", {}), object.vector("translate", {})};
}

std::string read_surface(const JsonObject& object, std::string_view fallback,
                         const fs::path& folder) {
  const std::string surface = object.text("surface", fallback);
  if (surface.empty())
    object.place().key("surface").fail("no surface",
                                       "a mesh, a geometry image or builtin:NAME is wanted");
  return resolved(surface, folder);
}

/// Names become file names, so they must be plain.
std::string read_name(const JsonObject& object, std::string_view fallback) {
  std::string name = object.text("name", fallback);
  const bool plain =
      !name.empty() && name[0] != '.' &&
      name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.") ==
          std::string::npos;
  if (!plain)
    object.place().key("name").fail(
        fmt::format("'{}'", name),
        "a name of letters, digits, '_', '-' and '.' is wanted: files are named by it");
  return name;
}

Vec2d read_image_point(const nlohmann::json& value, const JsonPlace& place) {
  const std::vector<double> uv = numbers_of(value, place, 2);
  for (const double x : uv)
    if (x < 0 || x > 1)
      place.fail(fmt::format("[{}, {}]", uv[0], uv[1]), "u and v from 0 to 1 are wanted");
  return {uv[0], uv[1]};
}

MotionKey read_motion_key(const nlohmann::json& value, const JsonPlace& place) {
  const JsonObject object(value, place, scene_keys::motion_key);
  MotionKey key;
  key.time = object.number("time", 0, not_negative);
  key.rotate = object.vector("rotate", {});
  key.translate = object.vector("translate", {});
  return key;
}

/// Keys at ascending times; empty where there are none.
std::vector<MotionKey> read_path(const JsonObject& object) {
  std::vector<MotionKey> path;
  const nlohmann::json* list = object.find("path");
  if (list == nullptr) return path;
  const JsonPlace place = object.place().key("path");
  if (!list->is_array() || list->empty())
    place.fail("no list of keys", "[{\"time\", \"rotate\", \"translate\"}, ...] is wanted");
  for (std::size_t i = 0; i < list->size(); ++i) {
    path.push_back(read_motion_key((*list)[i], place.element(i)));
    if (i > 0 && path[i].time <= path[i - 1].time)
      place.element(i).key("time").fail(fmt::format("{} after {}", path[i].time, path[i - 1].time),
                                        "ascending times are wanted");
  }
  return path;
}

PinPlace read_pin_place(const JsonObject& object) {
  const JsonPlace& place = object.place();
  const int ways = (object.has("image") ? 1 : 0) + (object.has("nearest") ? 1 : 0) +
                   (object.has("region") ? 1 : 0);
  if (ways != 1)
    place.fail(fmt::format("{} places", ways),
               "one of \"image\", \"nearest\" and \"region\" is wanted");
  if (const nlohmann::json* image = object.find("image"))
    return ImagePin{read_image_point(*image, place.key("image"))};
  if (object.has("nearest")) return NearestPin{object.vector("nearest", {})};
  const nlohmann::json& region = *object.find("region");
  const JsonPlace at = place.key("region");
  if (!region.is_array() || region.size() != 2)
    at.fail("no pair of points", "[[u0, v0], [u1, v1]] is wanted");
  const RegionPin pin{read_image_point(region[0], at.element(0)),
                      read_image_point(region[1], at.element(1))};
  if (pin.lower.x > pin.upper.x || pin.lower.y > pin.upper.y)
    at.fail("an empty region", "the first point below the second is wanted");
  return pin;
}

ScenePin read_pin(const nlohmann::json& value, const JsonPlace& place) {
  const JsonObject object(value, place, scene_keys::pin);
  return {read_pin_place(object), read_path(object)};
}

std::vector<ScenePin> read_pins(const JsonObject& object) {
  std::vector<ScenePin> pins;
  const nlohmann::json* list = object.find("pins");
  if (list == nullptr) return pins;
  const JsonPlace place = object.place().key("pins");
  if (!list->is_array()) place.fail("no list", "a list of pins is wanted");
  for (std::size_t i = 0; i < list->size(); ++i)
    pins.push_back(read_pin((*list)[i], place.element(i)));
  return pins;
}

Material material_by_name(const std::string& name, const JsonPlace& place) {
  if (const auto material = find_material(name)) return *material;
  std::vector<std::string_view> names;
  for (const NamedMaterial& named : named_materials()) names.push_back(named.name);
  place.fail(fmt::format("unknown material '{}'", name),
             fmt::format("the nearest known is '{}'", nearest_name(name, names)));
}

}  // namespace

Material read_material(const nlohmann::json& value, const JsonPlace& place) {
  if (value.is_string()) return material_by_name(value.get<std::string>(), place);
  const JsonObject object(value, place, scene_keys::material);
  const Material fallback;
  Material material;
  material.density = object.number("density", fallback.density, positive);
  material.stretch = object.number("stretch", fallback.stretch, not_negative);
  material.shear = object.number("shear", fallback.shear, not_negative);
  material.bending = object.number("bending", fallback.bending, not_negative);
  material.bend_springs = object.number("bend_springs", fallback.bend_springs, not_negative);
  material.damping = object.number("damping", fallback.damping, not_negative);
  material.strain_limit = object.number("strain_limit", fallback.strain_limit, {0, 0.999, false});
  material.thickness = object.number("thickness", fallback.thickness, positive);
  return material;
}

SceneCloth read_cloth(const nlohmann::json& value, const JsonPlace& place, const fs::path& folder) {
  const JsonObject object(value, place, scene_keys::cloth);
  SceneCloth cloth;
  cloth.name = read_name(object, cloth.name);
  cloth.surface = read_surface(object, cloth.surface, folder);
  cloth.size = object.integer("size", cloth.size, least_image_size, largest_image_size);
  cloth.placement = read_placement(object);
  if (const nlohmann::json* material = object.find("material"))
    cloth.material = read_material(*material, place.key("material"));
  cloth.friction = object.number("friction", cloth.friction, friction_range);
  cloth.velocity = object.vector("velocity", {});
  cloth.pins = read_pins(object);
  cloth.self_collision = object.boolean("self_collision", cloth.self_collision);
  object.refuse("attach", "cloths hang on pins here; leave the key out");
  return cloth;
}

SceneBody read_body(const nlohmann::json& value, const JsonPlace& place, const fs::path& folder) {
  const JsonObject object(value, place, scene_keys::body);
  SceneBody body;
  body.name = read_name(object, body.name);
  body.surface = read_surface(object, "", folder);
  body.size = object.integer("size", body.size, least_image_size, largest_image_size);
  body.placement = read_placement(object);
  body.friction = object.number("friction", body.friction, friction_range);
  for (const std::string_view key : {"motion", "animation", "lead_in"})
    object.refuse(key, "bodies stand still here; leave the key out");
  return body;
}

}  // namespace weft
