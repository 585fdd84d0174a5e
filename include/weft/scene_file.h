#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "weft/scene.h"

namespace weft {

/// Reads a scene. Relative paths of surfaces start from the scene's folder.
/// @throws SceneError  FILE:KEY for an unknown key (naming the nearest known one), a wrong type, a
///                     value out of range; FILE:LINE for what is not JSON
Scene read_scene(const std::filesystem::path& path);
Scene parse_scene(std::string_view text, const std::string& name,
                  const std::filesystem::path& folder);

/// Checks that the scene's collider supports what the scene asks for; reading checks it, too.
/// @param name  of the scene, for the error  @throws SceneError FILE:KEY
void check_abilities(const Scene& scene, const std::string& name);

/// Writes a scene with every key, so that reading it back gives the same scene. @throws OutputError
void write_scene(const std::filesystem::path& path, const Scene& scene);
/// The text that write_scene writes to a path.
std::string scene_text(const Scene& scene, const std::filesystem::path& path);

/// A material as the JSON object that a scene file holds, in one line.
std::string material_text(const Material& material);

}  // namespace weft
