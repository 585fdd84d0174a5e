#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "weft/run.h"
#include "weft/scene.h"

namespace weft {

/// The files that a scene's surfaces and animations are read from; built-in shapes are among them
/// by their names.
std::vector<std::filesystem::path> input_files(const Scene& scene);

/// Refuses a run that would write one of its files over one that it is made of.
/// @param scene_file  that the scene was read from; no file: it was read from none
/// @throws OutputError
void check_inputs_stay(const Scene& scene, const std::filesystem::path& scene_file,
                       const RunOptions& options);

}  // namespace weft
