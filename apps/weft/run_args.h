#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/weft/context.h"
#include "weft/run.h"

namespace CLI {
class App;
}

namespace weft::app {

/// The options that simulate, drape and garment share.
struct RunArgs {
  std::string folder, integrator, collider, material;
  int frames = 0, substeps = 0;  ///< 0: as the scene says
  std::vector<std::string> exports{"obj", "pc2"};
  std::string on = "auto";
  std::string unit, up;  ///< empty: as the scene says
  bool unwelded = false, verify = false, resume = false;
  bool until_rest = false;  // no option: the command tells
  std::optional<int> checkpoint;
  std::filesystem::path scene_file;  ///< where the scene is written, if anywhere
};
void add_run_options(CLI::App& command, RunArgs& args);

/// Unit and axes of files by the options. @param otherwise  what the options leave open
MeshFrame frame_of(const RunArgs& args, const MeshFrame& otherwise);

/// Changes the scene as the options ask.
void apply_run_args(const RunArgs& args, Scene& scene);

/// Runs the scene with the options applied and prints its report.
/// @throws whatever the run throws; Error with ExitCode::check_failed when a check of --verify
/// fails
void run_and_report(Scene scene, const std::string& name, const RunArgs& args,
                    const Context& context);

}  // namespace weft::app
