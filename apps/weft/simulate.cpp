#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/run_args.h"
#include "weft/scene_file.h"

namespace weft::app {
namespace {

struct SimulateArgs {
  std::string scene;
  RunArgs run;
};

void simulate(const SimulateArgs& args, const Context& context) {
  run_and_report(read_scene(args.scene), args.scene, args.run, context);
}

}  // namespace

void add_simulate(CLI::App& program, const Context& context) {
  auto args = std::make_shared<SimulateArgs>();
  CLI::App* command = program.add_subcommand("simulate", "Run a scene and write its caches");
  command->add_option("SCENE", args->scene, "Scene file, see docs/scene.md")->required();
  add_run_options(*command, args->run);
  command->footer("Example: weft simulate scene.json -o run --frames 60");
  command->callback([args, &context] { simulate(*args, context); });
}

}  // namespace weft::app
