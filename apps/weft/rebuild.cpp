#include <filesystem>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/reports.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/geometry_image.h"
#include "weft/image_file.h"
#include "weft/mesh.h"

namespace weft::app {
namespace {

struct RebuildArgs {
  std::string image, output;
  int level = 0;
};

/// The level of the image that is asked for.
GeometryImage read_level(const RebuildArgs& args) {
  GeometryImage image = read_image(args.image);
  if (args.level == 0) return image;
  if (std::optional<GeometryImage> coarse = coarser_image(image, args.level)) return *coarse;
  throw UsageError("--level", fmt::format("{} of {}", args.level, args.image),
                   fmt::format("a level from 0 to {} that keeps the seams and the topology",
                               coarsest_level(image)));
}

void rebuild(const RebuildArgs& args, const Context& context) {
  check_output(args.output, {".obj", ".ply"});
  check_not_input(args.output, std::vector<std::filesystem::path>{args.image});
  const GeometryImage image = read_level(args);
  const RebuiltMesh rebuilt = rebuild_mesh(image);
  const Json found = [&] {
    try {
      return image_json(image);
    } catch (const TopologyError& error) {
      throw TopologyError(args.image, error.what(), "");
    }
  }();
  write_mesh(args.output, rebuilt.mesh, vertex_colours(image, rebuilt));
  say(context, fmt::format("mesh    {} vertices, {} triangles, {}, {} borders",
                           found["vertices"].get<int>(), found["triangles"].get<int>(),
                           genus_text(found["genus"]), found["boundaries"].get<int>()));
  say(context, "wrote   " + args.output);
  print_report(context,
               {{"input", {{"path", args.image}}}, {"image", found}, {"outputs", {args.output}}});
}

}  // namespace

void add_rebuild(CLI::App& program, const Context& context) {
  auto args = std::make_shared<RebuildArgs>();
  CLI::App* command =
      program.add_subcommand("rebuild", "Turn a geometry image back into a mesh, seams closed");
  command->add_option("IMAGE", args->image, "Geometry image: .exr, .png or .weft")->required();
  command->add_option("-o,--output", args->output, "MESH.obj or MESH.ply")->required();
  command
      ->add_option("--level", args->level, "Of every 2^L-th sample: levels of detail, seams closed")
      ->check(CLI::Range(0, 12))
      ->capture_default_str();
  command->footer("Example: weft rebuild bunny.exr -o bunny-again.obj");
  command->callback([args, &context] { rebuild(*args, context); });
}

}  // namespace weft::app
