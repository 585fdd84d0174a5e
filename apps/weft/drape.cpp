#include "weft/sim/drape.h"

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/run_words.h"
#include "weft/image/convert.h"
#include "weft/image/io/image_file.h"
#include "weft/mesh/units.h"

namespace weft::app {
namespace {

struct DrapeWords {
  std::string cloth, body;
  DrapeOptions options;
  RunWords run;
};

/// Cloth keeps its size, and moves by it; bodies are scaled.
void warn_of_size(const std::string& cloth, const MeshFrame& files, const Context& context) {
  if (is_image_name(cloth)) return;
  const auto remark = implausible_size(in_metres_y_up(load_mesh(cloth), files), files.unit);
  if (remark) warn(context, cloth + ": " + *remark);
}

void drape(const DrapeWords& words, const Context& context) {
  DrapeOptions options = words.options;
  options.files = frame_of(words.run, options.files);
  const Scene scene = make_drape_scene(words.cloth, words.body, options);
  warn_of_size(words.cloth, options.files, context);
  RunWords run = words.run;
  run.scene_file = std::filesystem::path(words.run.folder) / "scene.json";
  run_and_report(scene, run.scene_file.string(), run, context);
}

}  // namespace

void add_drape(CLI::App& program, const Context& context) {
  auto words = std::make_shared<DrapeWords>();
  CLI::App* command =
      program.add_subcommand("drape", "Lay a cloth over a body: makes the scene, then runs it");
  command->add_option("CLOTH", words->cloth, "Mesh, geometry image or builtin:NAME")->required();
  command->add_option("BODY", words->body, "Mesh, geometry image or builtin:NAME")->required();
  command->add_option("--size", words->options.cloth_size, "Samples a side of the cloth")
      ->check(CLI::Range(least_image_size, largest_image_size))
      ->capture_default_str();
  command->add_flag("--as-is", words->options.as_is,
                    "Keep the body's size instead of scaling it to 1 m");
  add_run_options(*command, words->run);
  command->footer("Example: weft drape builtin:sheet builtin:mannequin -o draped");
  command->callback([words, &context] { drape(*words, context); });
}

}  // namespace weft::app
