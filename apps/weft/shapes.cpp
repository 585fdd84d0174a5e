#include "weft/shapes.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/reports.h"
#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/repair.h"

namespace weft::app {
namespace {

struct ShapesArgs {
  std::string name, output;
};

void list_shapes(const Context& context) {
  Json list = Json::array();
  for (const ShapeInfo& shape : built_in_shapes()) {
    say(context, fmt::format("{:<12} {}", shape.name, shape.description));
    list.push_back({{"name", shape.name}, {"description", shape.description}});
  }
  print_report(context, {{"shapes", list}});
}

void write_shape(const ShapesArgs& args, const Context& context) {
  check_output(args.output, {".obj", ".ply"});
  const TriangleMesh mesh = make_shape(args.name);
  write_mesh(args.output, mesh);
  const std::string name = "builtin:" + args.name;
  say(context, fmt::format("{}: {} vertices, {} triangles", name, mesh.positions.size(),
                           mesh.triangles.size()));
  say(context, "wrote   " + args.output);
  const RepairedMesh checked = repair_mesh(mesh, {name, {}});
  print_report(context, {{"input", input_json(name, checked)}, {"outputs", {args.output}}});
}

void shapes(const ShapesArgs& args, const Context& context) {
  if (args.name.empty() && args.output.empty()) return list_shapes(context);
  if (args.name.empty())
    throw UsageError("shapes", "-o without a name", "the name of a shape is wanted");
  if (args.output.empty())
    throw UsageError("shapes", "a name without -o", "-o MESH.obj or .ply is wanted");
  write_shape(args, context);
}

}  // namespace

void add_shapes(CLI::App& program, const Context& context) {
  auto args = std::make_shared<ShapesArgs>();
  CLI::App* command =
      program.add_subcommand("shapes", "List the built-in shapes, or write one as a mesh");
  command->add_option("NAME", args->name, "Which shape");
  command->add_option("-o,--output", args->output, "MESH.obj or MESH.ply");
  command->footer("Example: weft shapes mannequin -o mannequin.obj");
  command->callback([args, &context] { shapes(*args, context); });
}

}  // namespace weft::app
