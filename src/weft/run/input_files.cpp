#include "weft/run/input_files.h"

#include "weft/error.h"
#include "weft/files.h"
#include "weft/point_cache.h"
#include "weft/run/checkpoint.h"
#include "weft/run/run_manifest.h"

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
  for (const SceneCloth& cloth : scene.cloths) add(cloth.name);
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

}  // namespace

std::vector<fs::path> input_files(const Scene& scene) {
  std::vector<fs::path> files;
  const auto add = [&](const Surface& surface) {
    if (!surface.in_memory()) files.emplace_back(surface.name);
  };
  for (const SceneCloth& cloth : scene.cloths) add(cloth.surface);
  for (const SceneBody& body : scene.bodies) {
    add(body.surface);
    if (body.animation.in_memory()) continue;
    files.emplace_back(body.animation.name);
    if (body.animation.empty()) continue;
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
