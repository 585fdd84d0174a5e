#include "weft/run/run_identity.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/cloth/cloth.h"
#include "weft/core/hash.h"
#include "weft/core/json.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/point_cache.h"
#include "weft/run/checkpoint.h"
#include "weft/run/run_manifest.h"
#include "weft/scene_file.h"
#include "weft/shapes.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

/// The files that a run writes into its folder, but for those in folders of frames.
std::vector<fs::path> output_files(const Scene& scene, const RunOptions& options) {
  const fs::path& folder = options.folder;
  std::vector<fs::path> files{folder / "frames.csv", folder / "caches.json",
                              folder / "weft-run.json", checkpoint_path(folder)};
  if (!options.scene_file.empty()) files.push_back(options.scene_file);
  const auto add = [&](const std::string& name) {
    for (const char* ending :
         {".exr", ".pc2", ".image.pc2", ".draped.obj", ".panels.exr", ".panels.npz"})
      files.push_back(folder / (name + ending));
    for (const std::string& format : options.exports)
      for (const std::string& ending :
           {"." + format, std::string(format == "vtp" ? ".pvd" : ".obj")})
        files.push_back(folder / (name + ending));
  };
  for (const SceneCloth& cloth : scene.cloths) {
    add(cloth.name);
    files.push_back(rest_path(folder, cloth.name));
  }
  for (const SceneBody& body : scene.bodies) {
    add(body.name);
    files.push_back(normals_path(folder, body.name));
  }
  return files;
}

/// The folders that frames go into which are files of their own.
std::vector<fs::path> frame_folders(const Scene& scene, const RunOptions& options) {
  std::vector<fs::path> folders;
  for (const std::string& format : options.exports) {
    for (const SceneCloth& cloth : scene.cloths)
      folders.push_back(options.folder / (cloth.name + "_" + format));
    for (const SceneBody& body : scene.bodies)
      folders.push_back(options.folder / (body.name + "_" + format));
  }
  return folders;
}

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
    Planes3 along(cloth.size);
    if (cloth.material.stretch.warp != cloth.material.stretch.weft) {
      along.x = cloth.springs[stretch_u].stiffness;
      along.y = cloth.springs[stretch_v].stiffness;
      named.cloths[i].surface.name += surface_name(along, cloth.mates);
    }
    if (cloth.material.bending.warp != cloth.material.bending.weft && cloth.bending.active) {
      along.x = cloth.bending.weight[0];
      along.y = cloth.bending.weight[1];
      along.z = cloth.bending.weight[2];
      named.cloths[i].surface.name += surface_name(along, cloth.mates);
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

std::vector<fs::path> input_files(const Scene& scene) {
  std::vector<fs::path> files;
  const auto add = [&](const Surface& surface) {
    if (!surface.in_memory() && !is_builtin(surface.name)) files.emplace_back(surface.name);
  };
  for (const SceneCloth& cloth : scene.cloths) add(cloth.surface);
  for (const SceneBody& body : scene.bodies) {
    add(body.surface);
    if (body.animation.in_memory() || body.animation.empty()) continue;
    files.emplace_back(body.animation.name);
    try {
      for (const fs::path& file : point_cache_files(body.animation.name)) files.push_back(file);
    } catch (const InputError&) {  // they were there when they were read, which was enough
    }
  }
  return files;
}

void check_inputs_stay(const Scene& scene, const fs::path& scene_file, const RunOptions& options) {
  std::vector<fs::path> inputs = input_files(scene);
  if (scene_file != options.scene_file) inputs.push_back(scene_file);
  for (const fs::path& output : output_files(scene, options)) check_not_input(output, inputs);
  // Frames of earlier runs are removed from the folders of this one's.
  for (const fs::path& folder : frame_folders(scene, options))
    for (const fs::path& input : inputs)
      if (std::error_code none; fs::equivalent(input.parent_path(), folder, none))
        check_not_input(input, inputs);
}

}  // namespace weft
