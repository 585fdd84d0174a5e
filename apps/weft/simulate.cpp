#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/run_words.h"
#include "weft/sim/scene_file.h"

namespace weft::app {
namespace {

struct SimulateWords {
  std::string scene;
  RunWords run;
};

void simulate(const SimulateWords& words, const Context& context) {
  run_and_report(read_scene(words.scene), words.scene, words.run, context);
}

}  // namespace

void add_simulate(CLI::App& program, const Context& context) {
  auto words = std::make_shared<SimulateWords>();
  CLI::App* command = program.add_subcommand("simulate", "Run a scene and write its caches");
  command->add_option("SCENE", words->scene, "Scene file, see docs/scene.md")->required();
  add_run_options(*command, words->run);
  command->footer("Example: weft simulate scene.json -o run --frames 60");
  command->callback([words, &context] { simulate(*words, context); });
}

}  // namespace weft::app
