#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "weft/run.h"
#include "weft/scene.h"

namespace weft {

/// Identity of a run as JSON: the scene with every key but the number of frames, with surfaces
/// replaced by hashes of their samples and animations by hashes of their bytes (so that a changed
/// file is another scene, a moved one is not), and what is recorded.
std::string run_identity(const Scene& scene, const Simulation& simulation,
                         const RunOptions& options);

/// The first key by which two identities differ, with both values; empty when they are the same.
std::string identity_difference(const std::string& found, const std::string& wanted);

/// The files that a scene's surfaces and animations are read from; built-in shapes are among them
/// by their names.
std::vector<std::filesystem::path> input_files(const Scene& scene);

/// Refuses a run that would write one of its files over one that it is made of.
/// @param scene_file  that the scene was read from; no file: it was read from none
/// @throws OutputError
void check_inputs_stay(const Scene& scene, const std::filesystem::path& scene_file,
                       const RunOptions& options);

}  // namespace weft
