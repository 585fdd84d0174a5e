#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/core/names.h"
#include "weft/fabric.h"
#include "weft/garment.h"
#include "weft/point_cache.h"
#include "weft/shapes.h"
#include "weft/sim/scene_file/scene_parts.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr NumberRange friction_range{0, 10, false};
constexpr int max_layers = 20;

std::string resolved(const std::string& surface, const fs::path& folder) {
  if (is_builtin(surface)) return surface;
  return fs::absolute(folder / surface).lexically_normal().string();
}

/// Reads a scale: a number for all three axes, or three.
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

/// An animation: a file; FILE#NAME, one of a glTF file's; or the name alone, of the surface's file.
Animation read_animation(const JsonObject& object, const std::string& surface,
                         const fs::path& folder) {
  if (!object.has("animation")) return {};
  const std::string name = object.text("animation", "");
  if (is_point_cache_name(name)) return resolved(name, folder);
  // Folders may have the mark in their names, and animations, too.
  for (std::size_t mark = name.find('#'); mark != name.npos; mark = name.find('#', mark + 1))
    if (const std::string file = name.substr(0, mark); is_gltf_name(file))
      return {resolved(file, folder), name.substr(mark + 1)};
  if (is_gltf_name(surface) && !name.empty()) return {surface, name};
  object.place()
      .key("animation")
      .fail(
          fmt::format("'{}'", name),
          fmt::format(
              "{}{}", point_cache_wanted,
              is_gltf_name(surface) ? ", or the name of an animation of the surface's file" : ""));
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
  material.stretch = object.warp_weft("stretch", fallback.stretch);
  material.shear = object.number("shear", fallback.shear, not_negative);
  material.bending = object.warp_weft("bending", fallback.bending);
  material.bend_springs = object.number("bend_springs", fallback.bend_springs, not_negative);
  material.damping = object.number("damping", fallback.damping, not_negative);
  material.strain_limit = object.number("strain_limit", fallback.strain_limit, {0, 0.999, false});
  material.thickness = object.number("thickness", fallback.thickness, positive);
  return material;
}

namespace {

/// The rest shape: `mesh`, as it is placed, or `uv` with `uv_scale`.
std::optional<TextureRest> read_rest(const JsonObject& object) {
  const std::string rest = object.text("rest", "mesh");
  const JsonPlace& place = object.place();
  if (rest != "mesh" && rest != "uv")
    place.key("rest").fail(fmt::format("'{}'", rest), "mesh or uv is wanted");
  const nlohmann::json* scale = object.find("uv_scale");
  if (rest == "mesh" && scale != nullptr)
    place.key("uv_scale").fail("scales nothing", "\"rest\": \"uv\" beside it is wanted");
  if (rest == "mesh") return std::nullopt;
  TextureRest flat;
  if (scale != nullptr && scale->is_string()) {
    if (*scale != "auto")
      place.key("uv_scale")
          .fail(fmt::format("'{}'", scale->get<std::string>()),
                "metres a unit of the texture, or auto, are wanted");
  } else if (scale != nullptr) {
    flat.scale = object.number("uv_scale", 1, positive);
  }
  return flat;
}

}  // namespace

SceneCloth read_cloth(const nlohmann::json& value, const JsonPlace& place, const fs::path& folder) {
  const JsonObject object(value, place, scene_keys::cloth);
  SceneCloth cloth;
  cloth.name = read_name(object, cloth.name);
  cloth.surface = read_surface(object, cloth.surface.name, folder);
  cloth.size = object.integer("size", cloth.size, min_image_size, largest_image_size);
  for (const char* key : {"sew", "layer"})
    if (object.has(key) && !is_pattern_name(cloth.surface.name))
      place.key(key).fail("is of no garment", "a sewing pattern as the surface is wanted");
  if (const nlohmann::json* sew = object.find("sew"))
    cloth.spacing = JsonObject(*sew, place.key("sew"), scene_keys::sew)
                        .number("spacing", cloth.spacing, {0.0001, 1, false});
  if (object.has("layer")) cloth.layer = object.integer("layer", 0, 0, max_layers);
  cloth.rest = read_rest(object);
  cloth.placement = read_placement(object);
  if (const nlohmann::json* material = object.find("material"))
    cloth.material = read_material(*material, place.key("material"));
  cloth.friction = object.number("friction", cloth.friction, friction_range);
  cloth.velocity = object.vector("velocity", {});
  cloth.pins = read_pins(object);
  cloth.attach = read_attachments(object);
  if (object.has("self_collision")) cloth.self_collision = object.boolean("self_collision", false);
  return cloth;
}

SceneBody read_body(const nlohmann::json& value, const JsonPlace& place, const fs::path& folder) {
  const JsonObject object(value, place, scene_keys::body);
  SceneBody body;
  body.name = read_name(object, body.name);
  body.surface = read_surface(object, "", folder);
  body.size = object.integer("size", body.size, min_image_size, largest_image_size);
  body.placement = read_placement(object);
  body.friction = object.number("friction", body.friction, friction_range);
  body.motion = read_motion(object, "motion");
  body.animation = read_animation(object, body.surface.name, folder);
  if (!body.motion.empty() && !body.animation.empty())
    place.key("animation").fail("is there beside motion", "one of both is wanted");
  body.wait = object.number("wait", body.wait, not_negative);
  body.lead_in = object.number("lead_in", body.lead_in, not_negative);
  for (const char* key : {"wait", "lead_in"})
    if (object.has(key) && body.motion.empty() && body.animation.empty())
      place.key(key).fail("leads to nothing", "motion or animation beside it is wanted");
  return body;
}

}  // namespace weft
