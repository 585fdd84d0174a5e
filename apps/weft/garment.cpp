#include "weft/garment.h"

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/weft/commands.h"
#include "apps/weft/number_args.h"
#include "apps/weft/run_args.h"
#include "weft/error.h"
#include "weft/scene.h"

namespace weft::app {
namespace {

constexpr double millimetre = 0.001;
constexpr int default_frames = 240;
/// As while it is sewn: hems would swing for ten seconds. [1/s]
constexpr double damping_until_rest = 6;

struct GarmentArgs {
  std::string pattern, body;
  double spacing = default_spacing / millimetre;
  RunArgs run;
};

void sew_garment(const GarmentArgs& args, const Context& context) {
  if (!is_pattern_name(args.pattern))
    throw InputError(args.pattern, "is no sewing pattern",
                     "a GarmentCode pattern (.json) is wanted");
  // Refuses what cannot be sewn before the body is converted, which takes seconds.
  static_cast<void>(read_pattern(args.pattern));
  Scene scene;
  scene.frames = default_frames;
  SceneCloth garment;
  garment.name = "garment";
  garment.surface = args.pattern;
  garment.spacing = millimetre * args.spacing;
  scene.cloths.push_back(garment);
  SceneBody body;
  body.surface = args.body;
  scene.bodies.push_back(body);
  RunArgs run = args.run;
  run.until_rest = args.run.frames == 0;
  if (run.until_rest) scene.air_damping = damping_until_rest;
  run.scene_file = std::filesystem::path(args.run.folder) / "scene.json";
  run_and_report(scene, run.scene_file.string(), run, context);
}

}  // namespace

void add_garment(CLI::App& program, const Context& context) {
  auto args = std::make_shared<GarmentArgs>();
  CLI::App* command =
      program.add_subcommand("garment", "Sew a pattern on a body: makes the scene, then runs it");
  command->add_option("PATTERN", args->pattern, "Sewing pattern (GarmentCode JSON)")->required();
  command
      ->add_option("--body", args->body,
                   "Mesh, geometry image or builtin:NAME, where the pattern expects it")
      ->required();
  command->add_option("--spacing", args->spacing, "Distance of samples along edges [mm]")
      ->check(number_between(0.1, 1000))
      ->capture_default_str();
  add_run_options(*command, args->run);
  command->get_option("--frames")
      ->description(
          fmt::format("Frames to run; by default until it rests, {} at most", default_frames));
  command->footer("Example: weft garment tshirt.json --body figure.obj -o dressed");
  command->callback([args, &context] { sew_garment(*args, context); });
}

}  // namespace weft::app
