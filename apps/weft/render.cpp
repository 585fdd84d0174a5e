#include <algorithm>
#include <climits>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/drawing.h"
#include "apps/weft/number_args.h"
#include "apps/weft/reports.h"
#include "apps/weft/shots.h"
#include "apps/weft/shown.h"
#include "apps/weft/strain_colours.h"
#include "apps/weft/terminal_progress.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/picture.h"
#include "weft/shapes.h"

namespace weft::app {
namespace {

/// Programs show GIFs of more pictures a second slowly. [1/s]
constexpr double max_gif_rate = 50;

struct RenderArgs {
  std::vector<std::string> subjects, labels;
  ShownArgs shown;  // of each mesh and image
  std::string output;
  int frame = -1;
  double full_strain = 0;  // percent; 0: as the runs need
  bool turntable = false;
  double azimuth = 26, elevation = 14;  // degrees
};

bool is_movie(const RenderArgs& args) {
  const std::string ending = ending_of(args.output);
  return ending == ".mp4" || ending == ".gif";
}

bool is_run(const std::string& subject) {
  std::error_code ignored;  // reported when it is read
  return std::filesystem::is_directory(subject, ignored);
}

bool shows_strain(const RenderArgs& args) { return args.shown.show == "strain"; }

/// The colours of an .mp4 are those of two pixels each way: of others it could not hold the last.
bool wants_even_size(const RenderArgs& args) { return ending_of(args.output) == ".mp4"; }

void check_size(const RenderArgs& args) {
  for (const auto& [option, pixels] :
       {std::pair{"--width", args.shown.view.width}, {"--height", args.shown.view.height}})
    if (wants_even_size(args) && pixels % 2 != 0)
      throw UsageError(option, fmt::format("{} pixels of an .mp4", pixels),
                       "an even number, or a .gif, is wanted");
}

void check(const RenderArgs& args) {
  check_size(args);
  const auto runs = std::count_if(args.subjects.begin(), args.subjects.end(), is_run);
  const bool any_run = runs > 0, only_runs = runs == std::ssize(args.subjects);
  if (only_runs && !args.shown.show.empty() && args.shown.show != "run" && !shows_strain(args))
    throw UsageError("--show", "'" + args.shown.show + "' of a run",
                     "run or strain is wanted, or leave it out");
  for (const std::string& subject : args.subjects)
    if (shows_strain(args) && !is_run(subject))
      throw UsageError("--show", "strain of " + subject + ", which is no folder of a run",
                       "a run is wanted");
  if (args.full_strain > 0 && !shows_strain(args))
    throw UsageError("--full-strain", "no strain is shown", "--show strain is wanted");
  for (const auto& [option, given] : {std::pair{"--size", args.shown.size > 0},
                                      {"--against", !args.shown.against.empty()},
                                      {"--parameterizer", !args.shown.parameterizer.empty()}})
    if (only_runs && given)
      throw UsageError(option, "the subject is a run",
                       "a mesh or an image is wanted, or leave it out");
  if (!any_run && is_movie(args) && !args.turntable)
    throw UsageError(args.output, "a movie of something that does not move",
                     "--turntable or a PNG is wanted for images and meshes");
  if (args.turntable && !is_movie(args))
    throw UsageError("--turntable", "the output is a picture", "a .mp4 or .gif is wanted");
  if (!any_run && args.frame >= 0)
    throw UsageError("--frame", "the subject is no run", "a run's folder is wanted");
  if (args.frame >= 0 && is_movie(args) && !args.turntable)
    throw UsageError("--frame", "a movie of one frame", "--turntable or a PNG is wanted");
  if (!args.labels.empty() && args.labels.size() != args.subjects.size())
    throw UsageError("--labels", std::to_string(args.labels.size()) + " names",
                     std::to_string(args.subjects.size()) + " are wanted, with commas between");
}

/// The last part of a path without its ending, or the built-in shape's name.
std::string name_of(const std::string& subject) {
  if (is_builtin(subject)) return subject.substr(builtin_prefix.size());
  std::filesystem::path path = subject;
  if (!path.has_filename()) path = path.parent_path();
  return is_run(subject) ? path.filename().string() : path.stem().string();
}

/// The same scale for all, of the frames that are shown.
void scale_strain(const RenderArgs& args, const std::vector<RunSubject*>& runs) {
  double most = 0;
  for (const RunSubject* run : runs) {
    std::vector<int> frames{frame_of(*run, args.frame)};
    if (args.frame < 0 && is_movie(args)) frames = frames_to_look_at(*run);
    for (const int frame : frames) most = std::max(most, run->max_strain(frame));
  }
  for (RunSubject* run : runs)
    run->set_full_strain(args.full_strain > 0 ? args.full_strain / 100 : rounded_scale(most));
}

Shots open_subjects(const RenderArgs& args, const Context& context) {
  const ViewFrom view = part_of_row(args.shown.view, static_cast<int>(args.subjects.size()));
  std::vector<std::unique_ptr<Subject>> subjects;
  std::vector<RunSubject*> strained;
  std::vector<std::string> labels = args.labels;
  for (const std::string& name : args.subjects) {
    if (args.labels.empty() && args.subjects.size() > 1) labels.push_back(name_of(name));
    if (is_run(name)) {
      auto run = std::make_unique<RunSubject>(open_run_folder(name), view, shows_strain(args));
      if (shows_strain(args)) strained.push_back(run.get());
      subjects.push_back(std::move(run));
    } else {
      ShownArgs shown = args.shown;
      shown.subject = name;
      shown.view = view;
      subjects.push_back(std::make_unique<Shown>(shown, context));
    }
  }
  scale_strain(args, strained);
  return {std::move(subjects), std::move(labels), args.shown.view};
}

/// A picture with white to the right and below where a side is odd, as rows of several may have it.
Picture with_even_size(Picture picture) {
  if (picture.width % 2 == 0 && picture.height % 2 == 0) return picture;
  Picture even = blank_picture(picture.width + picture.width % 2,
                               picture.height + picture.height % 2, {1, 1, 1});
  paste(even, picture, 0, 0);
  return even;
}

void film(const RenderArgs& args, Shots& shots, const Context& context) {
  if (args.turntable && shots.any_flat())
    throw UsageError("--turntable", "a flat picture does not turn",
                     "--show cut, stretch, surface or error is wanted");
  const auto frame = args.frame >= 0 ? std::optional<int>(args.frame) : std::nullopt;
  const bool is_gif = ending_of(args.output) == ".gif";
  const Shots::Take take = args.turntable ? shots.turning(frame)
                           : is_gif       ? shots.playing(max_gif_rate)
                                          : shots.playing();
  TerminalProgress progress(context.quiet || context.json);
  std::optional<MovieWriter> movie;
  for (int i = 0; i < take.count; ++i) {
    update(&progress, "drawing", static_cast<double>(i) / take.count);
    Picture picture = shots.draw(take, i);
    if (wants_even_size(args)) picture = with_even_size(std::move(picture));
    if (!movie) movie.emplace(args.output, picture.width, picture.height, take.rate);
    movie->add(picture);
  }
  movie->finish();
}

void render(RenderArgs& args, const Context& context) {
  check_output(args.output, {".png", ".mp4", ".gif"});
  check_not_input(args.output,
                  std::vector<std::filesystem::path>(args.subjects.begin(), args.subjects.end()));
  args.shown.view.azimuth = args.azimuth * std::numbers::pi / 180;
  args.shown.view.elevation = args.elevation * std::numbers::pi / 180;
  check(args);
  Shots shots = open_subjects(args, context);
  if (!has_font())
    warn(context, "no font for labels and legends (DejaVu Sans): they are left blank");
  if (is_movie(args))
    film(args, shots, context);
  else
    write_png(args.output, shots.still(args.frame));
  say(context, "wrote   " + args.output);
  Json inputs = Json::array();
  for (const std::string& subject : args.subjects) inputs.push_back({{"path", subject}});
  print_report(context,
               {{"input", inputs.front()}, {"inputs", inputs}, {"outputs", {args.output}}});
}

void add_view_options(CLI::App& command, RenderArgs& args) {
  command
      .add_option("--width", args.shown.view.width,
                  "Pixels, even of an .mp4; colours, map and mates have whole pixels a sample, "
                  "and at least the shorter side")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  command.add_option("--height", args.shown.view.height, "Pixels, even of an .mp4")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  command.add_option("--azimuth", args.azimuth, "Of the eye, degrees; 0 looks from +z")
      ->check(any_number())
      ->capture_default_str();
  command.add_option("--elevation", args.elevation, "Of the eye, degrees")
      ->check(number_between(-89, 89))
      ->capture_default_str();
}

void add_show_options(CLI::App& command, RenderArgs& args) {
  command
      .add_option("--show", args.shown.show,
                  "Of a mesh: cut (default), map, stretch, colours, surface, mates, error; of an "
                  "image: colours (default), surface, cut, stretch, mates, error; of a run: run "
                  "(default), strain")
      ->check(CLI::IsMember(
          {"run", "strain", "cut", "map", "stretch", "colours", "surface", "mates", "error"}));
  command
      .add_option("--full-strain", args.full_strain,
                  "Percent that strain in full colour stands for; what 99 of 100 samples have at "
                  "most, rounded up, when not given")
      ->check(number_between(0.001, 1e6));
  command.add_option("--against", args.shown.against, "Mesh to measure an image's error to");
  command
      .add_option("--size", args.shown.size,
                  "Samples a side, where a mesh is converted to be shown; 257 when not given")
      ->check(CLI::Range(min_image_size, largest_image_size));
  command.add_option("--parameterizer", args.shown.parameterizer, "How a mesh is mapped then")
      ->check(CLI::IsMember({"floater", "stretch"}));
  command.add_flag("--turntable", args.turntable,
                   "A movie of one turn around a mesh or an image, or a run as it plays");
  command
      .add_option("--labels", args.labels,
                  "Names below the pictures; those of the files if not given")
      ->delimiter(',');
}

}  // namespace

void add_render(CLI::App& program, const Context& context) {
  auto args = std::make_shared<RenderArgs>();
  CLI::App* command =
      program.add_subcommand("render", "Draw runs, geometry images, meshes or sewing patterns");
  command
      ->add_option("DIR|IMAGE|MESH|PATTERN", args->subjects,
                   "Folder of a run, geometry image, mesh, builtin:NAME or sewing pattern; several "
                   "are drawn side by side from one camera")
      ->required();
  command->add_option("-o,--output", args->output, "PICTURE.png, or MOVIE.mp4 or .gif")->required();
  command->add_option("--frame", args->frame, "Of a run; the last when not given")
      ->check(CLI::Range(0, INT_MAX));
  add_show_options(*command, *args);
  add_view_options(*command, *args);
  command->footer("Example: weft render draped -o draped.mp4");
  command->callback([args, &context, command] {
    args->shown.sized = command->count("--width") + command->count("--height") > 0;
    render(*args, context);
  });
}

}  // namespace weft::app
