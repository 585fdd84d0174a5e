#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "weft/threads.h"

namespace weft::viewer {

struct ViewerOptions {
  std::string subject;  ///< scene, folder of a run, geometry image, mesh or builtin:NAME
  int width = 1280, height = 800;
  int threads = 1;
  InstructionSet instructions = best_instruction_set();
  bool paused = false;
  int until = 0;   ///< pauses at this frame of the scene, and closes; 0: never
  int frames = 0;  ///< closes after so many pictures of the subject; 0: when the user closes it
  std::filesystem::path folder = ".";   ///< of the pictures that S takes
  std::filesystem::path screenshot{};   ///< the whole window at its end; empty: none
  std::filesystem::path status_file{};  ///< the report, renewed by every picture; empty: none
  std::function<void(const std::string&)> say = [](const std::string&) {};
  std::function<void()> check = [] {};  ///< called repeatedly; what it throws ends the viewer
};

/// Shows a window until the user closes it. Errors of the subject are shown in the window.
/// @return its report at the end (see to_json)
/// @throws Error with ExitCode::input where no window can be opened; OutputError
nlohmann::ordered_json run_viewer(const ViewerOptions& options);

}  // namespace weft::viewer
