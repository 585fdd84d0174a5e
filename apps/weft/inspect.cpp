#include "apps/weft/inspect.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/reports.h"
#include "apps/weft/terminal_progress.h"
#include "weft/convert.h"
#include "weft/error.h"
#include "weft/garment.h"
#include "weft/image_file.h"
#include "weft/image_quality.h"

namespace weft::app {
namespace {

void compare_meshes(const InspectArgs& args, const Context& context);

void inspect(const InspectArgs& args, const Context& context) {
  if (is_image_name(args.subject)) return inspect_image(args, context);
  if (is_pattern_name(args.subject)) return inspect_pattern(args, context);
  check_frame(args.frame, args.against.empty() ? std::vector{args.subject}
                                               : std::vector{args.subject, args.against});
  if (!args.against.empty()) return compare_meshes(args, context);
  inspect_mesh(args, context);
}

}  // namespace

void add_inspect(CLI::App& program, const Context& context) {
  auto args = std::make_shared<InspectArgs>();
  CLI::App* command =
      program.add_subcommand("inspect", "Say what a mesh, a geometry image or a pattern is");
  command
      ->add_option("MESH|IMAGE|PATTERN", args->subject,
                   "Mesh, builtin:NAME, geometry image or sewing pattern (.json)")
      ->required();
  command->add_option("--against", args->against, "Mesh to measure the distance to")
      ->check([](const std::string& mesh) { return mesh.empty() ? "a mesh is wanted" : ""; });
  add_mesh_options(*command, args->frame);
  command->footer("Example: weft inspect bunny.exr --against bunny.obj");
  command->callback([args, &context] { inspect(*args, context); });
}
namespace {

Json one_sided_json(const OneSidedDistance& distance) {
  return {{"mean", distance.mean}, {"rms", distance.rms}, {"largest", distance.largest}};
}

/// @param kind  what the subject is called: image, or subject
void add_distances(const InspectArgs& args, const Context& context, const ImageQuality& quality,
                   const std::string& kind, Json& found) {
  found["psnr_db"] = quality.psnr_db;
  found["hausdorff_percent"] = quality.hausdorff_percent;
  found["from_mesh"] = one_sided_json(quality.from_mesh);
  found["from_" + kind] = one_sided_json(quality.from_image);
  say(context, fmt::format("against {}: PSNR {:.1f} dB, Hausdorff {:.2f} %", args.against,
                           quality.psnr_db, quality.hausdorff_percent));
  say(context, fmt::format("        from the mesh {:.3g} m (largest {:.3g}), from the {} {:.3g} m "
                           "(largest {:.3g})",
                           quality.from_mesh.rms, quality.from_mesh.largest, kind,
                           quality.from_image.rms, quality.from_image.largest));
}

void compare_meshes(const InspectArgs& args, const Context& context) {
  TerminalProgress progress(context.quiet || context.json);
  const TriangleMesh mesh = load_named_mesh(args.against, args.frame).mesh;
  const TriangleMesh subject = load_named_mesh(args.subject, args.frame).mesh;
  Json found = Json::object();
  add_distances(args, context,
                measure_mesh(subject, mesh, {context.threads, context.seed, &progress}), "subject",
                found);
  print_report(
      context,
      {{"input", {{"path", args.subject}}}, {"against", found}, {"outputs", Json::array()}});
}

void say_image(const Context& context, const GeometryImage& image,
               const ImageStatistics& statistics, const Json& found) {
  const Vec3d extent = statistics.box.extent();
  say(context, fmt::format("image   {0} x {0} of {1}, {2} bytes", image.size(), image.source,
                           found["bytes"].get<std::uintmax_t>()));
  say(context, fmt::format("box     {:.4g} x {:.4g} x {:.4g} m", extent.x, extent.y, extent.z));
  say(context, fmt::format("surface {}, {} border(s); mates {}, {} classes, the largest of {}",
                           genus_text(found["genus"]), found["boundaries"].get<int>(),
                           mates_bit_equal(image) ? "bit-equal" : "NOT equal",
                           image.mates.class_count(), statistics.largest_mate_class));
  say(context, fmt::format("map     stretch {:.3f} (L2), {:.1f} (largest, at row {}, column {})",
                           statistics.stretch_l2, statistics.stretch_linf, statistics.worst_quad[0],
                           statistics.worst_quad[1]));
  say(context, fmt::format("samples {} folded quads, {} triangles without area",
                           statistics.folded_quads, statistics.zero_area_triangles));
}

}  // namespace

void inspect_image(const InspectArgs& args, const Context& context) {
  if (args.against.empty() && !args.frame.given.empty())
    throw UsageError(args.frame.given.front(), "nothing is measured against a mesh",
                     "--against MESH is wanted, or leave it out");
  if (!args.against.empty()) check_frame(args.frame, std::vector{args.against});
  const GeometryImage image = read_image(args.subject);
  const ImageStatistics statistics = examine_image(image);
  Json found = image_json(image);
  found["bytes"] = std::filesystem::file_size(args.subject);
  found["bounding_box"] = box_json(statistics.box);
  found["largest_mate_class"] = statistics.largest_mate_class;
  found["stretch_l2"] = statistics.stretch_l2;
  found["stretch_linf"] = statistics.stretch_linf;
  found["worst_quad"] = statistics.worst_quad;
  found["folded_quads"] = statistics.folded_quads;
  found["zero_area_triangles"] = statistics.zero_area_triangles;
  say_image(context, image, statistics, found);
  if (!args.against.empty()) {
    TerminalProgress progress(context.quiet || context.json);
    const TriangleMesh mesh = load_named_mesh(args.against, args.frame).mesh;
    add_distances(args, context,
                  measure_image(image, mesh, {context.threads, context.seed, &progress}), "image",
                  found);
  }
  print_report(context,
               {{"input", {{"path", args.subject}}}, {"image", found}, {"outputs", Json::array()}});
}

}  // namespace weft::app
