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
  int frames = 0;  ///< closes after so many pictures of the subject; 0: when somebody closes it
  std::filesystem::path folder = ".";   ///< of the pictures that S takes
  std::filesystem::path screenshot{};   ///< the whole window at its end; empty: none
  std::filesystem::path status_file{};  ///< what to_json tells, all the while; empty: none
  std::function<void(const std::string&)> say = [](const std::string&) {};
  std::function<void()> check = [] {};  ///< called now and then; what it throws ends all
};

/// Shows a window until somebody closes it. What goes wrong with the subject is told in the window.
/// @return what there is to tell at its end (see to_json)
/// @throws Error with ExitCode::input where no window can be opened; OutputError
nlohmann::ordered_json run_viewer(const ViewerOptions& options);

}  // namespace weft::viewer
