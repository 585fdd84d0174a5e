// The writing half of weft/scene_file.h.
#include <ostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/scene_file.h"
#include "weft/shapes.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json to_json(Vec3d v) { return {v.x, v.y, v.z}; }
Json to_json(Vec2d v) { return {v.x, v.y}; }

/// Path of a surface relative to the scene's folder, so that the folder can be moved with its
/// files.
std::string surface_text(const Surface& surface, const fs::path& folder) {
  if (surface.in_memory())
    throw UsageError("scene", fmt::format("the surface '{}' is in memory alone", surface.name),
                     "a file or builtin:NAME, which a scene file can tell of, is wanted");
  if (is_builtin(surface.name)) return surface.name;
  return fs::absolute(surface.name)
      .lexically_normal()
      .lexically_proximate((fs::current_path() / folder).lexically_normal())
      .string();
}

std::string animation_text(const Animation& animation, const fs::path& folder) {
  if (animation.in_memory())
    throw UsageError("scene", fmt::format("the motion '{}' is in memory alone", animation.name),
                     "a point cache in a file is wanted");
  const std::string file = surface_text(animation.name, folder);
  return animation.clip.empty() ? file : fmt::format("{}#{}", file, animation.clip);
}

/// An integrator or a collider, with every option.
template <class Method>
Json method_json(const Method& method) {
  return std::visit(
      []<class Options>(const Options& options) {
        Json json{{"type", Options::name}};
        Options::visit_options([&](std::string_view key, auto member, const auto& /*range*/) {
          json[std::string(key)] = options.*member;
        });
        return json;
      },
      method);
}

/// One number where warp and weft are alike.
Json to_json(WarpWeft pair) {
  return pair.warp == pair.weft ? Json(pair.warp) : Json{pair.warp, pair.weft};
}

Json material_json(const Material& m) {
  return {
      {"density", m.density},           {"stretch", to_json(m.stretch)},  {"shear", m.shear},
      {"bending", to_json(m.bending)},  {"bend_springs", m.bend_springs}, {"damping", m.damping},
      {"strain_limit", m.strain_limit}, {"thickness", m.thickness}};
}

struct PinWriter {
  Json operator()(const ImagePin& pin) const { return {{"image", to_json(pin.uv)}}; }
  Json operator()(const NearestPin& pin) const { return {{"nearest", to_json(pin.point)}}; }
  Json operator()(const RegionPin& pin) const {
    return {{"region", Json::array({to_json(pin.lower), to_json(pin.upper)})}};
  }
};

void add_motion(Json& json, const char* name, const std::vector<MotionKey>& motion) {
  for (const MotionKey& key : motion)
    json[name].push_back({{"time", key.time},
                          {"rotate", to_json(key.rotate)},
                          {"translate", to_json(key.translate)}});
}

Json pin_json(const ScenePin& pin) {
  Json json = std::visit(PinWriter{}, pin.place);
  add_motion(json, "path", pin.path);
  return json;
}

Json attachment_json(const SceneAttachment& attachment) {
  Json json = std::visit(PinWriter{}, attachment.place);
  json["body"] = attachment.body;
  return json;
}

void add_placement(Json& json, const Placement& placement) {
  json["scale"] = to_json(placement.scale);
  json["rotate"] = to_json(placement.rotate);
  json["translate"] = to_json(placement.translate);
}

Json cloth_json(const SceneCloth& cloth, bool self_collision, const fs::path& folder) {
  Json json{
      {"name", cloth.name}, {"surface", surface_text(cloth.surface, folder)}, {"size", cloth.size}};
  if (cloth.spacing != default_spacing) json["sew"] = {{"spacing", cloth.spacing}};
  if (cloth.layer) json["layer"] = *cloth.layer;
  if (cloth.rest) {
    json["rest"] = "uv";
    json["uv_scale"] = cloth.rest->scale ? Json(*cloth.rest->scale) : Json("auto");
  }
  add_placement(json, cloth.placement);
  json["material"] = material_json(cloth.material);
  json["self_collision"] = self_collision;
  json["friction"] = cloth.friction;
  json["velocity"] = to_json(cloth.velocity);
  json["pins"] = Json::array();
  for (const ScenePin& pin : cloth.pins) json["pins"].push_back(pin_json(pin));
  json["attach"] = Json::array();
  for (const SceneAttachment& attachment : cloth.attach)
    json["attach"].push_back(attachment_json(attachment));
  return json;
}

Json body_json(const SceneBody& body, const fs::path& folder) {
  Json json{
      {"name", body.name}, {"surface", surface_text(body.surface, folder)}, {"size", body.size}};
  add_placement(json, body.placement);
  json["friction"] = body.friction;
  add_motion(json, "motion", body.motion);
  if (!body.animation.empty()) json["animation"] = animation_text(body.animation, folder);
  if (body.motion.empty() && body.animation.empty()) return json;
  json["wait"] = body.wait;
  json["lead_in"] = body.lead_in;
  return json;
}

Json scene_json(const Scene& scene, const fs::path& folder) {
  Json json{{"version", 1},
            {"gravity", to_json(scene.gravity)},
            {"frame_rate", scene.frame_rate},
            {"substeps", scene.substeps},
            {"frames", scene.frames}};
  json["ground"] = scene.ground ? Json(*scene.ground) : Json();
  json["wind"] = {{"velocity", to_json(scene.wind ? scene.wind->velocity : Vec3d{})}};
  if (scene.wind) {
    json["wind"]["drag"] = scene.wind->drag;
    json["wind"]["lift"] = scene.wind->lift;
  }
  json["air_damping"] = scene.air_damping;
  json["integrator"] = method_json(scene.integrator);
  if (scene.limiter_passes && Integrators::traits_of(scene.integrator).has_limiter)
    json["integrator"]["limiter_passes"] = *scene.limiter_passes;
  json["collider"] = method_json(scene.collider);
  json["unit"] = scene.files.unit.name;
  json["up"] = scene.files.up();
  json["cloths"] = Json::array();
  const bool able = Colliders::traits_of(scene.collider).self_collision;
  for (const SceneCloth& cloth : scene.cloths)
    json["cloths"].push_back(
        cloth_json(cloth, able && cloth.self_collision.value_or(true), folder));
  json["bodies"] = Json::array();
  for (const SceneBody& body : scene.bodies) json["bodies"].push_back(body_json(body, folder));
  return json;
}

}  // namespace

std::string scene_text(const Scene& scene, const fs::path& path) {
  try {
    return scene_json(scene, path.parent_path()).dump(2) + '\n';
  } catch (const Json::type_error&) {
    throw OutputError(path.string(), "a surface's path is not UTF-8, which JSON cannot hold",
                      "another name is wanted");
  }
}

std::string material_text(const Material& material) { return material_json(material).dump(); }

void write_scene(const fs::path& path, const Scene& scene) {
  const std::string text = scene_text(scene, path);
  write_file(path, [&](std::ostream& out) { out << text; });
}

}  // namespace weft
