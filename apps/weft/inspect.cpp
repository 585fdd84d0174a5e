#include "apps/weft/inspect.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "apps/weft/commands.h"
#include "weft/convert.h"
#include "weft/error.h"

namespace weft::app {
namespace {

void inspect(const InspectArgs& args, const Context& context) {
  if (is_image_name(args.subject)) return inspect_image(args, context);
  if (!args.against.empty())
    throw UsageError("--against", "the subject is a mesh",
                     "a geometry image is compared against a mesh");
  inspect_mesh(args, context);
}

}  // namespace

void add_inspect(CLI::App& program, const Context& context) {
  auto args = std::make_shared<InspectArgs>();
  CLI::App* command = program.add_subcommand("inspect", "Say what a mesh or a geometry image is");
  command->add_option("MESH|IMAGE", args->subject, "Mesh, builtin:NAME, or geometry image")
      ->required();
  command->add_option("--against", args->against, "Mesh to measure the image's distance to");
  add_mesh_options(*command, args->frame);
  command->footer("Example: weft inspect bunny.exr --against bunny.obj");
  command->callback([args, &context] { inspect(*args, context); });
}

}  // namespace weft::app
