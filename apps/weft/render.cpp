#include <climits>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/drawing.h"
#include "apps/weft/reports.h"
#include "apps/weft/shown.h"
#include "apps/weft/terminal_progress.h"
#include "weft/core/error.h"
#include "weft/core/math.h"
#include "weft/view/movie_writer.h"

namespace weft::app {
namespace {

/// One turn of a turntable.
constexpr int turn_frames = 120;
constexpr double turn_rate = 30;  // [1/s]

struct RenderWords {
  ShownWords shown;
  std::string output;
  int frame = -1;
  bool turntable = false;
  double azimuth = 26, elevation = 14;  // degrees
};

bool is_movie(const RenderWords& words) {
  const std::string ending = ending_of(words.output);
  return ending == ".mp4" || ending == ".gif";
}

void render_run(const RenderWords& words, const Context& context) {
  if (!words.shown.show.empty() && words.shown.show != "run")
    throw UsageError("--show", "'" + words.shown.show + "' of a run",
                     "a run shows itself; leave it out");
  if (words.turntable)
    throw UsageError("--turntable", "the subject is a run", "a mesh or an image is wanted");
  const RunFolder run = open_run_folder(words.shown.subject);
  TerminalProgress progress(context.quiet || context.json);
  if (is_movie(words)) return film_run(run, words.output, words.shown.view, &progress);
  write_png(words.output, draw_run(run, words.frame, words.shown.view));
}

void film_turn(Shown& shown, const RenderWords& words, const Context& context) {
  const ViewFrom& view = words.shown.view;
  TerminalProgress progress(context.quiet || context.json);
  MovieWriter movie(words.output, view.width, view.height, turn_rate);
  for (int frame = 0; frame < turn_frames; ++frame) {
    update(&progress, "drawing", static_cast<double>(frame) / turn_frames);
    movie.add(shown.draw(view.azimuth + 2 * pi * frame / turn_frames));
  }
  movie.finish();
}

void render_still(const RenderWords& words, const Context& context) {
  if (is_movie(words) && !words.turntable)
    throw UsageError(words.output, "a movie of something that does not move",
                     "--turntable or a PNG is wanted for images and meshes");
  if (words.turntable && !is_movie(words))
    throw UsageError("--turntable", "the output is a picture", "a .mp4 or .gif is wanted");
  if (words.frame >= 0)
    throw UsageError("--frame", "the subject is no run", "a run's folder is wanted");
  Shown shown(words.shown, context);
  if (!words.turntable) return write_png(words.output, shown.draw(words.shown.view.azimuth));
  if (shown.is_flat())
    throw UsageError("--turntable", "a flat picture does not turn",
                     "--show cut, stretch, surface or error is wanted");
  film_turn(shown, words, context);
}

void render(RenderWords& words, const Context& context) {
  check_output(words.output, {".png", ".mp4", ".gif"});
  words.shown.view.azimuth = words.azimuth * pi / 180;
  words.shown.view.elevation = words.elevation * pi / 180;
  if (std::filesystem::is_directory(words.shown.subject))
    render_run(words, context);
  else
    render_still(words, context);
  say(context, "wrote   " + words.output);
  print_report(context, {{"input", {{"path", words.shown.subject}}}, {"outputs", {words.output}}});
}

void add_view_options(CLI::App& command, RenderWords& words) {
  command.add_option("--width", words.shown.view.width, "Pixels")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  command.add_option("--height", words.shown.view.height, "Pixels")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  command.add_option("--azimuth", words.azimuth, "Of the eye, degrees; 0 looks from +z")
      ->capture_default_str();
  command.add_option("--elevation", words.elevation, "Of the eye, degrees")
      ->check(CLI::Range(-89.0, 89.0))
      ->capture_default_str();
}

void add_show_options(CLI::App& command, RenderWords& words) {
  command
      .add_option("--show", words.shown.show,
                  "Of a mesh: cut (default), map, stretch, colours, surface, mates, error; of an "
                  "image: colours (default), surface, cut, stretch, mates, error")
      ->check(
          CLI::IsMember({"run", "cut", "map", "stretch", "colours", "surface", "mates", "error"}));
  command.add_option("--against", words.shown.against, "Mesh to measure an image's error to");
  command
      .add_option("--size", words.shown.size,
                  "Samples a side, where a mesh is converted to be shown; 257 when not given")
      ->check(CLI::Range(least_image_size, largest_image_size));
  command.add_option("--parameterizer", words.shown.parameterizer, "How a mesh is mapped then")
      ->check(CLI::IsMember({"floater", "stretch"}));
  command.add_flag("--turntable", words.turntable, "A movie of one turn around a mesh or an image");
}

}  // namespace

void add_render(CLI::App& program, const Context& context) {
  auto words = std::make_shared<RenderWords>();
  CLI::App* command = program.add_subcommand("render", "Draw a run, a geometry image or a mesh");
  command
      ->add_option("DIR|IMAGE|MESH", words->shown.subject,
                   "Folder of a run, geometry image, mesh or builtin:NAME")
      ->required();
  command->add_option("-o,--output", words->output, "PICTURE.png, or MOVIE.mp4 or .gif")
      ->required();
  command->add_option("--frame", words->frame, "Of a run; the last when not given")
      ->check(CLI::Range(0, INT_MAX));
  add_show_options(*command, *words);
  add_view_options(*command, *words);
  command->footer("Example: weft render draped -o draped.mp4");
  command->callback([words, &context] { render(*words, context); });
}

}  // namespace weft::app
