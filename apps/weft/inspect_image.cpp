#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/inspect.h"
#include "apps/weft/reports.h"
#include "apps/weft/terminal_progress.h"
#include "weft/image/image_facts.h"
#include "weft/image/io/image_file.h"

namespace weft::app {
namespace {

Json one_sided_json(const OneSidedDistance& distance) {
  return {{"rms", distance.rms}, {"largest", distance.largest}};
}

void add_distances(const InspectWords& words, const Context& context, const GeometryImage& image,
                   Json& found) {
  TerminalProgress progress(context.quiet || context.json);
  const ImageQuality quality =
      measure_image(image, load_named_mesh(words.against, words.frame).mesh,
                    {context.threads, context.seed, &progress});
  found["psnr_db"] = quality.psnr_db;
  found["hausdorff_percent"] = quality.hausdorff_percent;
  found["from_mesh"] = one_sided_json(quality.from_mesh);
  found["from_image"] = one_sided_json(quality.from_image);
  say(context, fmt::format("against {}: PSNR {:.1f} dB, Hausdorff {:.2f} %", words.against,
                           quality.psnr_db, quality.hausdorff_percent));
  say(context,
      fmt::format("        from the mesh {:.3g} m (largest {:.3g}), from the image {:.3g} m "
                  "(largest {:.3g})",
                  quality.from_mesh.rms, quality.from_mesh.largest, quality.from_image.rms,
                  quality.from_image.largest));
}

void say_image(const Context& context, const GeometryImage& image, const ImageFacts& facts,
               const Json& found) {
  const Vec3d extent = facts.box.extent();
  say(context, fmt::format("image   {0} x {0} of {1}, {2} bytes", image.size(), image.source,
                           found["bytes"].get<std::uintmax_t>()));
  say(context, fmt::format("box     {:.4g} x {:.4g} x {:.4g} m", extent.x, extent.y, extent.z));
  say(context,
      fmt::format("surface genus {}, {} border(s); mates {}, {} classes, the largest of {}",
                  found["genus"].get<int>(), found["boundaries"].get<int>(),
                  mates_bit_equal(image) ? "bit-equal" : "NOT equal", image.mates.class_count(),
                  facts.largest_mate_class));
  say(context,
      fmt::format("map     stretch {:.3f} (L2), {:.1f} (largest, at row {}, column {})",
                  facts.stretch_l2, facts.stretch_linf, facts.worst_quad[0], facts.worst_quad[1]));
  say(context, fmt::format("samples {} folded quads, {} triangles without area", facts.folded_quads,
                           facts.zero_area_triangles));
}

}  // namespace

void inspect_image(const InspectWords& words, const Context& context) {
  const GeometryImage image = read_image(words.subject);
  const ImageFacts facts = examine_image(image);
  Json found = image_json(image);
  found["bytes"] = std::filesystem::file_size(words.subject);
  found["bounding_box"] = box_json(facts.box);
  found["largest_mate_class"] = facts.largest_mate_class;
  found["stretch_l2"] = facts.stretch_l2;
  found["stretch_linf"] = facts.stretch_linf;
  found["worst_quad"] = facts.worst_quad;
  found["folded_quads"] = facts.folded_quads;
  found["zero_area_triangles"] = facts.zero_area_triangles;
  say_image(context, image, facts, found);
  if (!words.against.empty()) add_distances(words, context, image, found);
  print_report(
      context,
      {{"input", {{"path", words.subject}}}, {"image", found}, {"outputs", Json::array()}});
}

}  // namespace weft::app
