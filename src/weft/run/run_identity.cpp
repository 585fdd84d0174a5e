#include "weft/run/run_identity.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/cloth/cloth.h"
#include "weft/core/hash.h"
#include "weft/core/json.h"
#include "weft/files.h"
#include "weft/point_cache.h"
#include "weft/scene_file.h"

namespace weft {
namespace {

using Json = nlohmann::json;

constexpr int deepest_nesting = 32;

/// Hash of a surface, as an absolute path, so that the scene writer keeps it except for the leading
/// slash.
std::string surface_name(const Planes3& placed, const BorderMates& mates) {
  Hash hash;
  for (const Grid<float>* plane : {&placed.x, &placed.y, &placed.z}) hash.add(*plane);
  for (int i = 0; i < mates.class_count(); ++i) hash.add(mates.mates(i));
  return std::string("/").append(hash.text());
}

/// Hash of what an animation is made of, in the same form.
std::string animation_name(const Animation& animation) {
  Hash hash;
  if (animation.in_memory()) {
    hash.add(std::span(animation.points->times));
    hash.add(std::span(animation.points->positions));
  } else {
    for (const std::filesystem::path& file : point_cache_files(animation.name)) {
      const std::string bytes = read_file(file);
      hash.add(std::span<const char>(bytes));
    }
    hash.add(std::span<const char>(animation.clip));
  }
  return std::string("/").append(hash.text());
}

/// Parsed JSON; null for what is no JSON.
Json parsed(const std::string& text) {
  try {
    return parse_json(text, deepest_nesting);
  } catch (const JsonFault&) {
    return {};
  }
}

std::string shown(const Json& json, const Json::json_pointer& key) {
  return json.contains(key) ? json_text(json.at(key)) : "missing";
}

}  // namespace

std::string run_identity(const Scene& scene, const Simulation& simulation,
                         const RunOptions& options) {
  Scene named = scene;
  for (std::size_t i = 0; i < named.cloths.size(); ++i) {
    const Cloth& cloth = *simulation.cloths()[i].model;
    named.cloths[i].surface = surface_name(cloth.rest, cloth.mates);
    // The grain, which may come from a texture.
    if (cloth.material.stretch.warp != cloth.material.stretch.weft) {
      Planes3 stiffness(cloth.size);
      stiffness.x = cloth.springs[stretch_u].stiffness;
      stiffness.y = cloth.springs[stretch_v].stiffness;
      named.cloths[i].surface.name += surface_name(stiffness, cloth.mates);
    }
    if (cloth.start) named.cloths[i].surface.name += surface_name(*cloth.start, cloth.mates);
  }
  for (std::size_t i = 0; i < named.bodies.size(); ++i) {
    const PlacedBody& body = simulation.bodies()[i];
    named.bodies[i].surface = surface_name(body.positions, body.image.mates);
    if (!named.bodies[i].animation.empty())
      named.bodies[i].animation = animation_name(named.bodies[i].animation);
  }
  Json json = parse_json(scene_text(named, "/scene.json"), deepest_nesting);
  json.erase("frames");
  std::vector<std::string> exports = options.exports;
  std::sort(exports.begin(), exports.end());
  json["--export"] = exports;
  json["--on"] = name_of(options.on);
  json["--unwelded"] = options.unwelded;
  json["--verify"] = options.verify;
  return json_text(json);
}

std::string identity_difference(const std::string& found, const std::string& wanted) {
  if (found == wanted) return {};
  const Json there = parsed(found), here = parsed(wanted);
  if (there.is_null() || here.is_null()) return "scene is none";
  const Json changes = Json::diff(there, here);
  if (changes.empty()) return {};
  // Another method has other keys, too; its type says most.
  const auto names_type = [](const Json& change) {
    return change.at("path").get<std::string>().ends_with("/type");
  };
  auto change = std::find_if(changes.begin(), changes.end(), names_type);
  if (change == changes.end()) change = changes.begin();
  const std::string key = change->at("path");
  const Json::json_pointer pointer(key);
  return fmt::format("{} is {} there and {} here", key.substr(1), shown(there, pointer),
                     shown(here, pointer));
}

}  // namespace weft
