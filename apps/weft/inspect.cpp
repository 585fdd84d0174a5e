#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/reports.h"
#include "apps/weft/terminal_progress.h"
#include "weft/core/error.h"
#include "weft/image/io/image_file.h"
#include "weft/mesh/facts.h"
#include "weft/mesh/repair.h"

namespace weft::app {
namespace {

constexpr std::size_t most_places = 20;

struct InspectWords {
  std::string subject, against;
};

template <class List>
Json first_places(const List& list) {
  return Json(List(list.begin(),
                   list.begin() + static_cast<std::ptrdiff_t>(std::min(list.size(), most_places))));
}

Json facts_json(const MeshFacts& facts) {
  return {{"nonmanifold_edges", facts.nonmanifold_edges},
          {"nonmanifold_vertices", facts.nonmanifold_vertices},
          {"nonmanifold_edge_list", first_places(facts.nonmanifold_edge_list)},
          {"nonmanifold_vertex_list", first_places(facts.nonmanifold_vertex_list)},
          {"orientable", facts.orientable},
          {"inconsistent_edges", facts.inconsistent_edges},
          {"border_edges", facts.border_edges},
          {"slivers", facts.slivers},
          {"least_quality", facts.least_quality}};
}

void say_facts(const Context& context, const MeshFacts& facts) {
  say(context,
      fmt::format("mesh          {} vertices, {} triangles, {} component(s), {} border edges",
                  facts.vertices, facts.triangles, facts.components, facts.border_edges));
  say(context, fmt::format("non-manifold  {} edges, {} vertices", facts.nonmanifold_edges,
                           facts.nonmanifold_vertices));
  say(context,
      fmt::format("orientation   {}, {} edges disagree",
                  facts.orientable ? "orientable" : "not orientable", facts.inconsistent_edges));
  say(context,
      fmt::format("slivers       {} (least quality {:.2g})", facts.slivers, facts.least_quality));
}

// What convert would make of the mesh: its repaired topology, or the error that it would end with.
Json fate_json(const std::string& name, const TriangleMesh& mesh, const MeshFacts& facts,
               std::string& verdict) {
  try {
    const RepairedMesh repaired = repair_mesh(mesh, {name, {}});
    verdict = fmt::format("converts: genus {}, {} border(s); {} repair(s)", repaired.counts.genus,
                          repaired.counts.boundaries, repaired.repairs.size());
    return input_json(name, repaired);
  } catch (const Error& error) {
    verdict = fmt::format("does not convert as it is: {}", error.what());
    return {{"path", name},
            {"vertices", facts.vertices},
            {"triangles", facts.triangles},
            {"components", facts.components},
            {"boundaries", nullptr},
            {"genus", nullptr},
            {"euler", nullptr},
            {"repairs", Json::array()},
            {"error", error.what()}};
  }
}

void inspect_mesh(const InspectWords& words, const Context& context) {
  const TriangleMesh mesh = load_mesh(words.subject);
  const MeshFacts facts = examine_mesh(mesh);
  say_facts(context, facts);
  std::string verdict;
  Json report{{"input", fate_json(words.subject, mesh, facts, verdict)}};
  report.update(facts_json(facts));
  say(context, verdict);
  print_report(context, report);
}

void add_distances(const InspectWords& words, const Context& context, const GeometryImage& image,
                   Json& found) {
  TerminalProgress progress(context.quiet || context.json);
  const ImageQuality quality =
      measure_image(image, load_mesh(words.against), {context.threads, context.seed, &progress});
  found["psnr_db"] = quality.psnr_db;
  found["hausdorff_percent"] = quality.hausdorff_percent;
  say(context, fmt::format("against {}: PSNR {:.1f} dB, Hausdorff {:.2f} %", words.against,
                           quality.psnr_db, quality.hausdorff_percent));
}

void inspect_image(const InspectWords& words, const Context& context) {
  const GeometryImage image = read_image(words.subject);
  Json found = image_json(image);
  say(context, fmt::format("image   {0} x {0} of {1}", image.size(), image.source));
  say(context,
      fmt::format("surface genus {}, {} border(s); mates {}, {} classes", found["genus"].get<int>(),
                  found["boundaries"].get<int>(),
                  mates_bit_equal(image) ? "bit-equal" : "NOT equal", image.mates.class_count()));
  if (!words.against.empty()) add_distances(words, context, image, found);
  print_report(
      context,
      {{"input", {{"path", words.subject}}}, {"image", found}, {"outputs", Json::array()}});
}

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
  command->footer("Example: weft inspect bunny.exr --against bunny.obj");
  command->callback([words, &context] { inspect(*words, context); });
}

}  // namespace weft::app
