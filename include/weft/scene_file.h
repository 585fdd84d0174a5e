#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "weft/scene.h"

namespace weft {

/// Reads a scene. Surfaces given as relative paths are taken from the scene's folder.
/// @throws SceneError  FILE:KEY for an unknown key (naming its nearest known neighbour), a wrong
/// type, a value
///                     out of range; FILE:LINE for what is not JSON
Scene read_scene(const std::filesystem::path& path);
Scene parse_scene(std::string_view text, const std::string& name,
                  const std::filesystem::path& folder);

/// Checks that the scene's collider can do what the scene asks for, which reading does, too.
/// @param name  of the scene, for the error  @throws SceneError FILE:KEY
void check_abilities(const Scene& scene, const std::string& name);

/// Writes a scene with every key, so that reading it back gives the same scene. @throws OutputError
void write_scene(const std::filesystem::path& path, const Scene& scene);
/// The same in memory: what a file at that path would hold.
std::string scene_text(const Scene& scene, const std::filesystem::path& path);

/// A material as the JSON object that a scene file holds, in one line.
std::string material_text(const Material& material);

}  // namespace weft
