#include <climits>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/drawing.h"
#include "apps/weft/reports.h"
#include "apps/weft/terminal_progress.h"
#include "weft/core/error.h"
#include "weft/core/math.h"
#include "weft/cut/open_to_disk.h"
#include "weft/image/io/image_file.h"
#include "weft/mesh/repair.h"
#include "weft/view/image_pictures.h"

namespace weft::app {
namespace {

struct RenderWords {
  std::string subject, output;
  int frame = -1, width = 1280, height = 720;
  double azimuth = 26, elevation = 14;  // degrees
};

bool is_movie(const RenderWords& words) {
  const std::string ending = ending_of(words.output);
  return ending == ".mp4" || ending == ".gif";
}

DrawingOptions options_of(const RenderWords& words) {
  return {words.width, words.height, words.azimuth * pi / 180, words.elevation * pi / 180};
}

// A mesh that cannot be opened is still drawn, without a cut.
Picture picture_of_mesh(const RenderWords& words, const Context& context) {
  const TriangleMesh mesh = load_mesh(words.subject);
  try {
    const RepairedMesh repaired = repair_mesh(mesh, {words.subject, {}});
    return draw_mesh(repaired.mesh, open_to_disk(repaired.mesh).edges, options_of(words));
  } catch (const TopologyError& error) {
    note(context, std::string("drawn without a cut: ") + error.what());
    return draw_mesh(mesh, {}, options_of(words));
  }
}

void render_run(const RenderWords& words, const Context& context) {
  const RunFolder run = open_run_folder(words.subject);
  TerminalProgress progress(context.quiet || context.json);
  if (is_movie(words)) return film_run(run, words.output, options_of(words), &progress);
  write_png(words.output, draw_run(run, words.frame, options_of(words)));
}

void render_still(const RenderWords& words, const Context& context) {
  if (is_movie(words))
    throw UsageError(words.output, "a movie of something that does not move",
                     "a PNG is wanted for images and meshes");
  write_png(words.output, is_image_name(words.subject) ? colours_of(read_image(words.subject))
                                                       : picture_of_mesh(words, context));
}

void render(const RenderWords& words, const Context& context) {
  check_output(words.output, {".png", ".mp4", ".gif"});
  if (std::filesystem::is_directory(words.subject))
    render_run(words, context);
  else
    render_still(words, context);
  say(context, "wrote   " + words.output);
  print_report(context, {{"input", {{"path", words.subject}}}, {"outputs", {words.output}}});
}

}  // namespace

void add_render(CLI::App& program, const Context& context) {
  auto words = std::make_shared<RenderWords>();
  CLI::App* command = program.add_subcommand("render", "Draw a run, a geometry image or a mesh");
  command
      ->add_option("DIR|IMAGE|MESH", words->subject,
                   "Folder of a run, geometry image, mesh or builtin:NAME")
      ->required();
  command->add_option("-o,--output", words->output, "PICTURE.png, or MOVIE.mp4 or .gif of a run")
      ->required();
  command->add_option("--frame", words->frame, "Of a run; the last when not given")
      ->check(CLI::Range(0, INT_MAX));
  command->add_option("--width", words->width, "Pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  command->add_option("--height", words->height, "Pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  command->add_option("--azimuth", words->azimuth, "Of the eye, degrees; 0 looks from +z")
      ->capture_default_str();
  command->add_option("--elevation", words->elevation, "Of the eye, degrees")
      ->check(CLI::Range(-89.0, 89.0))
      ->capture_default_str();
  command->footer("Example: weft render draped -o draped.mp4");
  command->callback([words, &context] { render(*words, context); });
}

}  // namespace weft::app
