#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/inspect.h"
#include "apps/weft/reports.h"
#include "weft/convert.h"
#include "weft/error.h"
#include "weft/mesh_statistics.h"
#include "weft/repair.h"

namespace weft::app {
namespace {

/// Largest numbers of places listed of each kind, in JSON and in text; the counts include all.
constexpr std::size_t max_places = 100, max_told = 8;

template <class List>
Json first_places(const List& list) {
  return Json(List(list.begin(),
                   list.begin() + static_cast<std::ptrdiff_t>(std::min(list.size(), max_places))));
}

template <class Value>
Json json_or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json components_json(const MeshStatistics& statistics) {
  Json list = Json::array();
  for (const ComponentStatistics& c : statistics.component_list) {
    if (list.size() == max_places) break;
    list.push_back({{"triangles", c.triangles},
                    {"vertices", c.vertices},
                    {"area", c.area},
                    {"boundaries", c.boundaries},
                    {"genus", json_or_null(c.genus())},
                    {"euler", c.euler()},
                    {"orientable", c.orientable},
                    {"closed", c.closed()}});
  }
  return list;
}

Json loops_json(const MeshStatistics& statistics) {
  Json list = Json::array();
  for (const BorderLoopStatistics& loop : statistics.border_loops) {
    if (list.size() == max_places) break;
    list.push_back({{"vertices", loop.edges},
                    {"length", loop.length},
                    {"component", loop.component},
                    {"least_vertex", loop.min_vertex}});
  }
  return list;
}

Json statistics_json(const MeshStatistics& statistics) {
  return {{"bounding_box", box_json(statistics.box)},
          {"area", statistics.area},
          {"volume", json_or_null(statistics.volume)},
          {"closed", statistics.closed},
          {"orientable", statistics.orientable},
          {"inconsistent_edges", statistics.inconsistent_edges},
          {"component_list", components_json(statistics)},
          {"border_edges", statistics.border_edges},
          {"border_loops", loops_json(statistics)},
          {"nonmanifold_edges", statistics.nonmanifold_edges},
          {"nonmanifold_vertices", statistics.nonmanifold_vertices},
          {"nonmanifold_edge_list", first_places(statistics.nonmanifold_edge_list)},
          {"nonmanifold_vertex_list", first_places(statistics.nonmanifold_vertex_list)},
          {"slivers", statistics.slivers},
          {"least_quality", statistics.min_quality},
          {"zero_area_triangles", statistics.zero_area_triangles},
          {"repeated_vertex_triangles", statistics.repeated_vertex_triangles},
          {"duplicate_triangles", statistics.duplicate_triangles},
          {"unreferenced_vertices", statistics.unreferenced_vertices},
          {"coincident_vertices", statistics.coincident_vertices},
          {"not_finite_vertices", statistics.not_finite_vertices},
          {"texture_coordinates", statistics.texture_coordinates},
          {"self_intersections", statistics.self_intersections},
          {"intersecting_triangles", statistics.intersecting_triangles},
          {"self_intersection_list", statistics.self_intersection_list}};
}

/// What a list of the first few leaves out.
void say_rest(const Context& context, const char* what, std::size_t count) {
  if (count > max_told)
    say(context,
        fmt::format("              and {} more {}; --json lists more", count - max_told, what));
}

void say_components(const Context& context, const MeshStatistics& statistics) {
  for (std::size_t k = 0; k < std::min(statistics.component_list.size(), max_told); ++k) {
    const ComponentStatistics& c = statistics.component_list[k];
    say(context,
        fmt::format("component {:<3} {} triangles, {} vertices, {:.4g} m^2, {} border(s), {}", k,
                    c.triangles, c.vertices, c.area, c.boundaries,
                    c.genus() ? fmt::format("genus {}", *c.genus()) : "no genus"));
  }
  say_rest(context, "components", statistics.component_list.size());
  for (std::size_t k = 0; k < std::min(statistics.border_loops.size(), max_told); ++k) {
    const BorderLoopStatistics& loop = statistics.border_loops[k];
    say(context, fmt::format("border {:<6} {} vertices, {:.4g} m, at vertex {}, component {}", k,
                             loop.edges, loop.length, loop.min_vertex, loop.component));
  }
  say_rest(context, "borders", statistics.border_loops.size());
}

void say_bad_places(const Context& context, const MeshStatistics& statistics) {
  std::string places;
  for (std::size_t k = 0; k < std::min(statistics.nonmanifold_edge_list.size(), max_told); ++k)
    places += fmt::format(" {}-{}", statistics.nonmanifold_edge_list[k][0],
                          statistics.nonmanifold_edge_list[k][1]);
  for (std::size_t k = 0; k < std::min(statistics.nonmanifold_vertex_list.size(), max_told); ++k)
    places += fmt::format(" {}", statistics.nonmanifold_vertex_list[k]);
  const bool more = std::max(statistics.nonmanifold_edge_list.size(),
                             statistics.nonmanifold_vertex_list.size()) > max_told;
  if (!places.empty()) places = "; vertices from 0:" + places + (more ? " ..." : "");
  say(context, fmt::format("non-manifold  {} edges, {} vertices{}", statistics.nonmanifold_edges,
                           statistics.nonmanifold_vertices, places));
}

std::string way_round(const MeshStatistics& statistics) {
  if (!statistics.volume) return "";
  return fmt::format(", volume {:.4g} m^3{}", *statistics.volume,
                     *statistics.volume < 0 ? " (inside out)" : "");
}

void say_statistics(const Context& context, const MeshStatistics& statistics) {
  const Vec3d extent = statistics.box.empty() ? Vec3d{} : statistics.box.extent();
  say(context, fmt::format("mesh          {} vertices, {} triangles, {} component(s), {}",
                           statistics.vertices, statistics.triangles, statistics.components,
                           statistics.closed ? "closed"
                                             : fmt::format("{} border edges in {} loop(s)",
                                                           statistics.border_edges,
                                                           statistics.border_loops.size())));
  say(context, fmt::format("box           {:.4g} x {:.4g} x {:.4g} m, area {:.4g} m^2{}", extent.x,
                           extent.y, extent.z, statistics.area, way_round(statistics)));
  say_components(context, statistics);
  say_bad_places(context, statistics);
  say(context, fmt::format("orientation   {}, {} edges disagree",
                           statistics.orientable ? "orientable" : "not orientable",
                           statistics.inconsistent_edges));
  say(context,
      fmt::format("triangles     {} slivers (least quality {:.2g}), {} without area, {} with "
                  "a repeated vertex, {} duplicates",
                  statistics.slivers, statistics.min_quality, statistics.zero_area_triangles,
                  statistics.repeated_vertex_triangles, statistics.duplicate_triangles));
  say(context,
      fmt::format(
          "vertices      {} unreferenced, {} at the place of another{}; {} texture coordinates",
          statistics.unreferenced_vertices, statistics.coincident_vertices,
          statistics.not_finite_vertices > 0
              ? fmt::format(", {} not finite", statistics.not_finite_vertices)
              : "",
          statistics.texture_coordinates ? "with" : "no"));
  say(context, fmt::format("crossings     {} pairs of triangles, {} triangles in all",
                           statistics.self_intersections, statistics.intersecting_triangles));
}

/// Outcome of converting a mesh: its repaired topology, its charts and the smallest size that holds
/// its cut, or the error.
struct Fate {
  Json input, min_size, charts;
  std::string verdict;
};

/// What convert makes of it by itself.
std::string charts_text(const CutPreview& cut) {
  return fmt::format("{} chart{}{}", cut.disks.size(), cut.disks.size() == 1 ? "" : "s",
                     cut.may_be_split ? ", more where that image would be poor" : "");
}

Fate fate_of(const std::string& name, const TriangleMesh& mesh, const MeshStatistics& statistics) {
  try {
    const CutPreview cut = preview_cut(mesh, name);
    const RepairedMesh& repaired = cut.input;
    std::string verdict = fmt::format("converts: {}, {} border(s); size {} or more; {}",
                                      genus_text(genus_json(repaired.counts)),
                                      repaired.counts.boundaries, cut.min_size, charts_text(cut));
    for (const std::string& repair : repaired.repairs) verdict += "; " + repair;
    const Json charts{{"least", cut.disks.size()}, {"may_be_split", cut.may_be_split}};
    return {input_json(name, repaired), cut.min_size, charts, verdict};
  } catch (const Error& error) {
    return {{{"path", name},
             {"vertices", statistics.vertices},
             {"triangles", statistics.triangles},
             {"components", statistics.components},
             {"boundaries", nullptr},
             {"genus", nullptr},
             {"euler", nullptr},
             {"repairs", Json::array()},
             {"error", error.what()}},
            nullptr,
            nullptr,
            fmt::format("does not convert as it is: {}", error.what())};
  }
}

}  // namespace

void inspect_mesh(const InspectArgs& args, const Context& context) {
  const auto [mesh, warnings] = load_named_mesh(args.subject, args.frame);
  for (const std::string& warning : warnings) warn(context, warning);
  const MeshStatistics statistics = examine_mesh(mesh);
  say_statistics(context, statistics);
  const Fate fate = fate_of(args.subject, mesh, statistics);
  Json report{{"input", fate.input}};
  report.update(statistics_json(statistics));
  report["least_size"] = fate.min_size;
  report["charts"] = fate.charts;
  say(context, fate.verdict);
  report["warnings"] = warnings;
  print_report(context, report);
}

}  // namespace weft::app
