#include <array>
#include <filesystem>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/mesh_args.h"
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
  int texture = 0;  // pixels a side of the picture; 0: none
  MeshArgs frame;
};

/// Texture coordinates of the triangles' corners: where samples lie in a picture of the image, the
/// middles of whose outermost pixels are the outermost samples.
std::vector<std::array<Vec2f, 3>> corner_texture(const GeometryImage& image, int pixels) {
  const int n = image.size();
  const auto along = [&](int line) { return (line * (pixels - 1.0) / (n - 1.0) + 0.5) / pixels; };
  const auto pixel = [&](int sample) {
    return Vec2f{static_cast<float>(along(sample % n)), static_cast<float>(1 - along(sample / n))};
  };
  std::vector<std::array<Vec2f, 3>> corners;
  for (const Triangle& t : grid_triangles(image))
    corners.push_back({pixel(t[0]), pixel(t[1]), pixel(t[2])});
  return corners;
}

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
  if (args.texture > 0 && ending_of(args.output) != ".obj")
    throw UsageError("--texture", "PLY files hold none here", ".obj is wanted");
  check_not_input(args.output, std::vector<std::filesystem::path>{args.image});
  const GeometryImage image = read_level(args);
  RebuiltMesh rebuilt = rebuild_mesh(image);
  const Json found = [&] {
    try {
      return image_json(image);
    } catch (const TopologyError& error) {
      throw TopologyError(args.image, error.what(), "");
    }
  }();
  if (args.texture > 0) rebuilt.mesh.corner_uv = corner_texture(image, args.texture);
  const MeshFrame frame = frame_of(args.frame);
  for (Vec3d& position : rebuilt.mesh.positions) position = in_frame(position, frame);
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
  command
      ->add_option("--texture", args->texture,
                   "Write texture coordinates, for a picture of the image of so many pixels a side")
      ->check(CLI::Range(2, 65536));
  add_mesh_options(*command, args->frame);
  command->footer("Example: weft rebuild bunny.exr -o bunny-again.obj");
  command->callback([args, &context] { rebuild(*args, context); });
}

}  // namespace weft::app
