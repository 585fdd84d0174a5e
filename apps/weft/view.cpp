#include <climits>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/viewer/viewer.h"
#include "apps/weft/commands.h"
#include "apps/weft/reports.h"
#include "apps/weft/terminal_progress.h"
#include "weft/error.h"

namespace weft::app {
namespace {

void view(viewer::ViewerOptions& options, const Context& context) {
  if (!options.screenshot.empty()) check_output(options.screenshot, {".png"});
  options.threads = context.threads;
  options.instructions = context.instructions;
  options.say = [&context](const std::string& line) { say(context, line); };
  TerminalProgress interruption(true);
  options.check = [&interruption] { interruption.update("view", 0); };
  const nlohmann::ordered_json report = viewer::run_viewer(options);
  print_report(context, report);
  // With these options nobody may have looked at the window.
  const std::string error = report.at("error");
  if ((options.frames > 0 || options.until > 0) && !error.empty())
    throw Error(ExitCode::input, "", error, "");
}

}  // namespace

void add_view(CLI::App& program, const Context& context) {
  auto options = std::make_shared<viewer::ViewerOptions>();
  CLI::App* command = program.add_subcommand("view", "Show a window in which cloth is pulled at");
  command
      ->add_option("SCENE.json|DIR|IMAGE|MESH", options->subject,
                   "Scene file, folder of a run, geometry image, mesh or builtin:NAME")
      ->required();
  command->add_option("--width", options->width, "Of the window")
      ->check(CLI::Range(320, 8192))
      ->capture_default_str();
  command->add_option("--height", options->height, "Of the window")
      ->check(CLI::Range(240, 8192))
      ->capture_default_str();
  command->add_option("-o,--output", options->folder, "Folder for the pictures that S takes")
      ->capture_default_str();
  command->add_flag("--paused", options->paused, "Begin without moving");
  command->add_option("--until", options->until, "Stop at this frame of the scene and close")
      ->check(CLI::Range(1, INT_MAX));
  command
      ->add_option("--frames", options->frames, "Close after so many pictures of what was opened")
      ->check(CLI::Range(1, INT_MAX));
  command->add_option("--screenshot", options->screenshot,
                      "Picture of the whole window when it closes");
  command->add_option("--status", options->status_file,
                      "File that always holds what --json prints at the end");
  command->footer(
      "Keys: Space pause, . one step, R reset, F frame, C colours, H panel, I geometry image,\n"
      "S picture (Shift-S with the panel), Esc quit. Mouse: the left button drags cloth or\n"
      "orbits, right or middle pans, the wheel zooms. A file dropped on the window opens.\n"
      "Example: weft view scene.json");
  command->callback([options, &context] { view(*options, context); });
}

}  // namespace weft::app
