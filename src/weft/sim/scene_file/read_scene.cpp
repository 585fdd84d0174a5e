#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/core/json.h"
#include "weft/core/names.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/scene_file.h"
#include "weft/sim/scene_file/scene_parts.h"

namespace weft {

MeshFrame read_frame(const JsonObject& object) {
  MeshFrame frame;
  const std::string unit = object.text("unit", frame.unit.name);
  const auto found = find_length_unit(unit);
  if (!found)
    object.place().key("unit").fail(fmt::format("'{}'", unit), "m, cm, mm or in is wanted");
  frame.unit = *found;
  const std::string up = object.text("up", frame.up());
  if (up != "y" && up != "z")
    object.place().key("up").fail(fmt::format("'{}'", up), "y or z is wanted");
  frame.z_up = up == "z";
  return frame;
}
namespace {

constexpr int max_substeps = 10'000;
constexpr int max_frames = 10'000'000;
constexpr int deepest_nesting = 32;

nlohmann::json parse_scene_json(std::string_view text, const std::string& name) {
  try {
    return parse_json(text, deepest_nesting);
  } catch (const JsonFault& fault) {
    throw SceneError(fault.place(name), fault.what(), fault.wanted("a scene file is wanted"));
  }
}

void check_version(const JsonObject& root) {
  if (root.integer("version", 1, 0, 1'000'000) != 1)
    root.place().key("version").fail("unknown version", "1 is wanted");
}

/// Reads the wind; a velocity of zero is no wind unless coefficients are given.
std::optional<WindOptions> read_wind(const JsonObject& root) {
  const nlohmann::json* value = root.find("wind");
  if (value == nullptr) return std::nullopt;
  const JsonObject object(*value, root.place().key("wind"), scene_keys::wind);
  WindOptions wind;
  wind.velocity = object.vector("velocity", wind.velocity);
  wind.drag = object.number("drag", wind.drag, not_negative);
  wind.lift = object.number("lift", wind.lift, not_negative);
  const bool given = object.has("drag") || object.has("lift");
  if (wind.velocity == Vec3d{} && !given) return std::nullopt;
  return wind;
}

template <class Part, class Read>
std::vector<Part> read_list(const JsonObject& root, std::string_view key, const Read& read) {
  std::vector<Part> parts;
  const nlohmann::json* list = root.find(key);
  if (list == nullptr) return parts;
  const JsonPlace place = root.place().key(key);
  if (!list->is_array()) place.fail("no list", fmt::format("a list of {} is wanted", key));
  for (std::size_t i = 0; i < list->size(); ++i)
    parts.push_back(read((*list)[i], place.element(i)));
  return parts;
}

/// Checks that names of cloths and bodies differ, as files are named by them, even on file systems
/// that ignore case.
void check_names(const Scene& scene, const JsonPlace& place) {
  std::map<std::string, std::string> seen;  // by lower-case name
  const auto check = [&](const std::string& name, std::string_view list, std::size_t index) {
    const auto [other, is_new] = seen.emplace(lower_case(name), name);
    if (is_new) return;
    const std::string twice = fmt::format("'{}' is there twice", name);
    const std::string alike =
        fmt::format("'{}' differs from '{}' in capital letters only", name, other->second);
    place.key(list).element(index).key("name").fail(
        other->second == name ? twice : alike,
        "a name of its own for each cloth and body is wanted");
  };
  for (std::size_t i = 0; i < scene.cloths.size(); ++i) check(scene.cloths[i].name, "cloths", i);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) check(scene.bodies[i].name, "bodies", i);
  // A cloth's sample cache lies beside that of its mesh, as its rest shape and what is told of a
  // garment do, a body's normal map beside its image.
  for (std::size_t i = 0; i < scene.cloths.size(); ++i)
    for (const char* const beside : {".image", ".rest", ".panels", ".draped"})
      check(scene.cloths[i].name + beside, "cloths", i);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    check(scene.bodies[i].name + ".image", "bodies", i);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    check(scene.bodies[i].name + ".normals", "bodies", i);
}

/// Checks that the bodies that cloths are tied to exist.
void check_attachments(const Scene& scene, const JsonPlace& place) {
  std::vector<std::string_view> names;
  for (const SceneBody& body : scene.bodies) names.push_back(body.name);
  for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
    const std::vector<SceneAttachment>& attach = scene.cloths[i].attach;
    for (std::size_t k = 0; k < attach.size(); ++k)
      if (std::find(names.begin(), names.end(), attach[k].body) == names.end())
        place.key("cloths").element(i).key("attach").element(k).key("body").fail(
            fmt::format("no body is called '{}'", attach[k].body),
            names.empty()
                ? "a scene with a body is wanted"
                : fmt::format("the nearest known is '{}'", nearest_name(attach[k].body, names)));
  }
}

void read_ground(const JsonObject& root, Scene& scene) {
  const nlohmann::json* ground = root.find("ground");
  if (ground != nullptr && ground->is_null()) {
    scene.ground.reset();
  } else {
    scene.ground = root.number("ground", *scene.ground);
  }
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name,
                  const std::filesystem::path& folder) {
  const nlohmann::json json = parse_scene_json(text, name);
  const JsonObject root(json, {name, ""}, scene_keys::scene);
  check_version(root);
  Scene scene;
  scene.gravity = root.vector("gravity", scene.gravity);
  scene.frame_rate = root.number("frame_rate", scene.frame_rate, positive);
  scene.substeps = root.integer("substeps", scene.substeps, 1, max_substeps);
  scene.frames = root.integer("frames", scene.frames, 0, max_frames);
  read_ground(root, scene);
  scene.wind = read_wind(root);
  scene.air_damping = root.number("air_damping", scene.air_damping, not_negative);
  if (const auto* value = root.find("integrator"))
    scene.integrator =
        read_integrator(*value, root.place().key("integrator"), scene.limiter_passes);
  if (const auto* value = root.find("collider"))
    scene.collider = read_collider(*value, root.place().key("collider"));
  scene.files = read_frame(root);
  scene.cloths = read_list<SceneCloth>(root, "cloths", [&](const auto& value, const auto& place) {
    return read_cloth(value, place, folder);
  });
  scene.bodies = read_list<SceneBody>(root, "bodies", [&](const auto& value, const auto& place) {
    return read_body(value, place, folder);
  });
  if (scene.cloths.empty()) root.place().key("cloths").fail("no cloth", "at least one is wanted");
  check_names(scene, root.place());
  check_attachments(scene, root.place());
  check_abilities(scene, name);
  return scene;
}

void check_abilities(const Scene& scene, const std::string& name) {
  const JsonPlace root{name, ""};
  const auto refuse = [&](const JsonPlace& place, std::string_view what, std::string_view wanted) {
    place.fail(fmt::format("{} not available with collider {}", what, name_of(scene.collider)),
               wanted);
  };
  for (std::size_t i = 0; i < scene.cloths.size(); ++i)
    if (scene.cloths[i].self_collision.value_or(false) &&
        !Colliders::traits_of(scene.collider).self_collision)
      refuse(root.key("cloths").element(i).key("self_collision"), "true is", "false is wanted");
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    if (Colliders::traits_of(scene.collider).moving_bodies) continue;
    for (const auto& [key, given] : {std::pair{"motion", !body.motion.empty()},
                                     std::pair{"animation", !body.animation.empty()}})
      if (given)
        refuse(root.key("bodies").element(i).key(key), "moving bodies are",
               "another collider, or bodies that stand still, are wanted");
  }
}

Scene read_scene(const std::filesystem::path& path) {
  return parse_scene(read_file(path), path.string(), path.parent_path());
}

}  // namespace weft
