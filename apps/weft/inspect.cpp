#include "apps/weft/inspect.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "apps/weft/commands.h"
#include "weft/core/error.h"
#include "weft/image/convert.h"

namespace weft::app {
namespace {

void inspect(const InspectWords& words, const Context& context) {
  if (is_image_name(words.subject)) return inspect_image(words, context);
  if (!words.against.empty())
    throw UsageError("--against", "the subject is a mesh",
                     "a geometry image is compared against a mesh");
  inspect_mesh(words, context);
}

}  // namespace

void add_inspect(CLI::App& program, const Context& context) {
  auto words = std::make_shared<InspectWords>();
  CLI::App* command = program.add_subcommand("inspect", "Say what a mesh or a geometry image is");
  command->add_option("MESH|IMAGE", words->subject, "Mesh, builtin:NAME, or geometry image")
      ->required();
  command->add_option("--against", words->against, "Mesh to measure the image's distance to");
  add_mesh_options(*command, words->frame);
  command->footer("Example: weft inspect bunny.exr --against bunny.obj");
  command->callback([words, &context] { inspect(*words, context); });
}

}  // namespace weft::app
