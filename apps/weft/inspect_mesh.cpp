#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/inspect.h"
#include "apps/weft/reports.h"
#include "weft/core/error.h"
#include "weft/cut/open_to_disk.h"
#include "weft/mesh/facts.h"
#include "weft/mesh/repair.h"
#include "weft/param/border_layout.h"

namespace weft::app {
namespace {

/// Of each kind, in JSON and in text; the counts tell how many there are.
constexpr std::size_t most_places = 100, most_told = 8;

template <class List>
Json first_places(const List& list) {
  return Json(List(list.begin(),
                   list.begin() + static_cast<std::ptrdiff_t>(std::min(list.size(), most_places))));
}

template <class Value>
Json json_or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json components_json(const MeshFacts& facts) {
  Json list = Json::array();
  for (const ComponentFacts& c : facts.component_list) {
    if (list.size() == most_places) break;
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

Json loops_json(const MeshFacts& facts) {
  Json list = Json::array();
  for (const BorderLoopFacts& loop : facts.border_loops) {
    if (list.size() == most_places) break;
    list.push_back({{"vertices", loop.edges},
                    {"length", loop.length},
                    {"component", loop.component},
                    {"least_vertex", loop.least_vertex}});
  }
  return list;
}

Json facts_json(const MeshFacts& facts) {
  return {{"bounding_box", box_json(facts.box)},
          {"area", facts.area},
          {"volume", json_or_null(facts.volume)},
          {"closed", facts.closed},
          {"orientable", facts.orientable},
          {"inconsistent_edges", facts.inconsistent_edges},
          {"component_list", components_json(facts)},
          {"border_edges", facts.border_edges},
          {"border_loops", loops_json(facts)},
          {"nonmanifold_edges", facts.nonmanifold_edges},
          {"nonmanifold_vertices", facts.nonmanifold_vertices},
          {"nonmanifold_edge_list", first_places(facts.nonmanifold_edge_list)},
          {"nonmanifold_vertex_list", first_places(facts.nonmanifold_vertex_list)},
          {"slivers", facts.slivers},
          {"least_quality", facts.least_quality},
          {"zero_area_triangles", facts.zero_area_triangles},
          {"repeated_vertex_triangles", facts.repeated_vertex_triangles},
          {"duplicate_triangles", facts.duplicate_triangles},
          {"unreferenced_vertices", facts.unreferenced_vertices},
          {"coincident_vertices", facts.coincident_vertices},
          {"not_finite_vertices", facts.not_finite_vertices},
          {"texture_coordinates", facts.texture_coordinates},
          {"self_intersections", facts.self_intersections},
          {"intersecting_triangles", facts.intersecting_triangles},
          {"self_intersection_list", facts.self_intersection_list}};
}

void say_components(const Context& context, const MeshFacts& facts) {
  for (std::size_t k = 0; k < std::min(facts.component_list.size(), most_told); ++k) {
    const ComponentFacts& c = facts.component_list[k];
    say(context,
        fmt::format("component {:<3} {} triangles, {} vertices, {:.4g} m^2, {} border(s), {}", k,
                    c.triangles, c.vertices, c.area, c.boundaries,
                    c.genus() ? fmt::format("genus {}", *c.genus()) : "no genus"));
  }
  for (std::size_t k = 0; k < std::min(facts.border_loops.size(), most_told); ++k) {
    const BorderLoopFacts& loop = facts.border_loops[k];
    say(context, fmt::format("border {:<6} {} vertices, {:.4g} m, at vertex {}, component {}", k,
                             loop.edges, loop.length, loop.least_vertex, loop.component));
  }
}

void say_bad_places(const Context& context, const MeshFacts& facts) {
  std::string places;
  for (std::size_t k = 0; k < std::min(facts.nonmanifold_edge_list.size(), most_told); ++k)
    places +=
        fmt::format(" {}-{}", facts.nonmanifold_edge_list[k][0], facts.nonmanifold_edge_list[k][1]);
  for (std::size_t k = 0; k < std::min(facts.nonmanifold_vertex_list.size(), most_told); ++k)
    places += fmt::format(" {}", facts.nonmanifold_vertex_list[k]);
  if (!places.empty()) places = "; vertices from 0:" + places;
  say(context, fmt::format("non-manifold  {} edges, {} vertices{}", facts.nonmanifold_edges,
                           facts.nonmanifold_vertices, places));
}

std::string way_round(const MeshFacts& facts) {
  if (!facts.volume) return "";
  return fmt::format(", volume {:.4g} m^3{}", *facts.volume,
                     *facts.volume < 0 ? " (inside out)" : "");
}

void say_facts(const Context& context, const MeshFacts& facts) {
  const Vec3d extent = facts.box.empty() ? Vec3d{} : facts.box.extent();
  say(context,
      fmt::format("mesh          {} vertices, {} triangles, {} component(s), {}", facts.vertices,
                  facts.triangles, facts.components,
                  facts.closed ? "closed"
                               : fmt::format("{} border edges in {} loop(s)", facts.border_edges,
                                             facts.border_loops.size())));
  say(context, fmt::format("box           {:.4g} x {:.4g} x {:.4g} m, area {:.4g} m^2{}", extent.x,
                           extent.y, extent.z, facts.area, way_round(facts)));
  say_components(context, facts);
  say_bad_places(context, facts);
  say(context,
      fmt::format("orientation   {}, {} edges disagree",
                  facts.orientable ? "orientable" : "not orientable", facts.inconsistent_edges));
  say(context,
      fmt::format("triangles     {} slivers (least quality {:.2g}), {} without area, {} with "
                  "a repeated vertex, {} duplicates",
                  facts.slivers, facts.least_quality, facts.zero_area_triangles,
                  facts.repeated_vertex_triangles, facts.duplicate_triangles));
  say(context,
      fmt::format(
          "vertices      {} unreferenced, {} at the place of another{}; {} texture coordinates",
          facts.unreferenced_vertices, facts.coincident_vertices,
          facts.not_finite_vertices > 0 ? fmt::format(", {} not finite", facts.not_finite_vertices)
                                        : "",
          facts.texture_coordinates ? "with" : "no"));
  say(context, fmt::format("crossings     {} pairs of triangles, {} triangles in all",
                           facts.self_intersections, facts.intersecting_triangles));
}

/// What convert would make of a mesh: its repaired topology and the least size that holds its cut,
/// or the error that it would end with.
struct Fate {
  Json input, least_size;
  std::string verdict;
};

Fate fate_of(const std::string& name, const TriangleMesh& mesh, const MeshFacts& facts) {
  try {
    const RepairedMesh repaired = repair_mesh(mesh, {name, {}});
    const int least = least_size(cut_open(repaired.mesh, open_to_disk(repaired.mesh)));
    std::string verdict = fmt::format("converts: genus {}, {} border(s); size {} or more",
                                      repaired.counts.genus, repaired.counts.boundaries, least);
    for (const std::string& repair : repaired.repairs) verdict += "; " + repair;
    return {input_json(name, repaired), least, verdict};
  } catch (const Error& error) {
    return {{{"path", name},
             {"vertices", facts.vertices},
             {"triangles", facts.triangles},
             {"components", facts.components},
             {"boundaries", nullptr},
             {"genus", nullptr},
             {"euler", nullptr},
             {"repairs", Json::array()},
             {"error", error.what()}},
            nullptr,
            fmt::format("does not convert as it is: {}", error.what())};
  }
}

}  // namespace

void inspect_mesh(const InspectWords& words, const Context& context) {
  const auto [mesh, warnings] = load_named_mesh(words.subject, words.frame);
  for (const std::string& warning : warnings) warn(context, warning);
  const MeshFacts facts = examine_mesh(mesh);
  say_facts(context, facts);
  const Fate fate = fate_of(words.subject, mesh, facts);
  Json report{{"input", fate.input}};
  report.update(facts_json(facts));
  report["least_size"] = fate.least_size;
  say(context, fate.verdict);
  report["warnings"] = warnings;
  print_report(context, report);
}

}  // namespace weft::app
