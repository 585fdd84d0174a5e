#include <cmath>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/weft/commands.h"
#include "apps/weft/run_args.h"
#include "weft/convert.h"
#include "weft/drape_scene.h"
#include "weft/image_file.h"
#include "weft/mesh.h"
#include "weft/shapes.h"

namespace weft::app {
namespace {

struct DrapeArgs {
  std::string cloth, body;
  DrapeOptions options;
  RunArgs run;
};

/// Warns of an implausible cloth size. Cloth keeps its size, which affects its motion; bodies are
/// scaled.
void warn_of_size(const std::string& cloth, const MeshFrame& files, const Context& context) {
  if (is_image_name(cloth) || is_builtin(cloth)) return;
  const auto remark = implausible_size(in_metres_y_up(load_mesh(cloth), files), files.unit);
  if (remark) warn(context, cloth + ": " + *remark);
}

/// Bodies are scaled to 1 m, which who brings one of a known size does not expect.
void tell_scale(const Scene& scene, const Context& context) {
  for (const SceneBody& body : scene.bodies)
    if (!is_builtin(body.surface.name) && std::abs(body.placement.scale.x - 1) > 1e-3)
      note(context, fmt::format("{}: scaled by {:.3g} to 1 m; --as-is keeps its size",
                                body.surface.name, body.placement.scale.x));
}

void drape(const DrapeArgs& args, const Context& context) {
  DrapeOptions options = args.options;
  options.files = frame_of(args.run, options.files);
  const Scene scene = make_drape_scene(args.cloth, args.body, options);
  warn_of_size(args.cloth, options.files, context);
  tell_scale(scene, context);
  RunArgs run = args.run;
  run.scene_file = std::filesystem::path(args.run.folder) / "scene.json";
  run_and_report(scene, run.scene_file.string(), run, context);
}

}  // namespace

void add_drape(CLI::App& program, const Context& context) {
  auto args = std::make_shared<DrapeArgs>();
  CLI::App* command =
      program.add_subcommand("drape", "Lay a cloth over a body: makes the scene, then runs it");
  command->add_option("CLOTH", args->cloth, "Mesh, geometry image or builtin:NAME")->required();
  command->add_option("BODY", args->body, "Mesh, geometry image or builtin:NAME")->required();
  command->add_option("--size", args->options.cloth_size, "Samples a side of the cloth")
      ->check(CLI::Range(min_image_size, largest_image_size))
      ->capture_default_str();
  command->add_flag("--as-is", args->options.as_is,
                    "Keep the body's size instead of scaling it to 1 m");
  add_run_options(*command, args->run);
  command->footer("Example: weft drape builtin:sheet builtin:mannequin -o draped");
  command->callback([args, &context] { drape(*args, context); });
}

}  // namespace weft::app
