#include "weft/image/rebuild.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/reports.h"
#include "weft/image/io/image_file.h"
#include "weft/mesh/io/write_mesh.h"

namespace weft::app {
namespace {

struct RebuildWords {
  std::string image, output;
};

void rebuild(const RebuildWords& words, const Context& context) {
  check_output(words.output, {".obj", ".ply"});
  const GeometryImage image = read_image(words.image);
  const RebuiltMesh rebuilt = rebuild_mesh(image);
  write_mesh(words.output, rebuilt.mesh);
  const Json found = image_json(image);
  say(context, fmt::format("mesh    {} vertices, {} triangles, genus {}, {} borders",
                           found["vertices"].get<int>(), found["triangles"].get<int>(),
                           found["genus"].get<int>(), found["boundaries"].get<int>()));
  say(context, "wrote   " + words.output);
  print_report(context,
               {{"input", {{"path", words.image}}}, {"image", found}, {"outputs", {words.output}}});
}

}  // namespace

void add_rebuild(CLI::App& program, const Context& context) {
  auto words = std::make_shared<RebuildWords>();
  CLI::App* command =
      program.add_subcommand("rebuild", "Turn a geometry image back into a mesh, seams closed");
  command->add_option("IMAGE", words->image, "Geometry image, .exr or .png")->required();
  command->add_option("-o,--output", words->output, "MESH.obj or MESH.ply")->required();
  command->footer("Example: weft rebuild bunny.exr -o bunny-again.obj");
  command->callback([words, &context] { rebuild(*words, context); });
}

}  // namespace weft::app
