#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/inspect.h"
#include "apps/weft/reports.h"
#include "weft/error.h"
#include "weft/garment.h"

namespace weft::app {
namespace {

/// [panels][edges] which seams an edge is in: PANEL.EDGE of each partner.
using Partners = std::vector<std::vector<Json>>;

Partners partners_of(const Pattern& pattern) {
  Partners partners;
  for (const PatternPanel& panel : pattern.panels)
    partners.emplace_back(panel.edges.size(), Json::array());
  const auto text = [&](const PanelEdge& at) {
    return fmt::format("{}.{}", pattern.panels[at.panel].name, at.edge);
  };
  for (const Stitch& stitch : pattern.stitches) {
    partners[stitch.a.panel][stitch.a.edge].push_back(text(stitch.b));
    partners[stitch.b.panel][stitch.b.edge].push_back(text(stitch.a));
  }
  return partners;
}

Json panel_json(const PatternPanel& panel, const std::vector<Json>& partners) {
  const PanelMeasures measures = measure_panel(panel);
  Json edges = Json::array();
  for (std::size_t k = 0; k < panel.edges.size(); ++k)
    edges.push_back({{"length", measures.edge_lengths[k]},
                     {"label", panel.edges[k].label},
                     {"sewn_to", partners[k]}});
  return {{"name", panel.name},
          {"label", panel.label},
          {"area", measures.area},
          {"extent", {measures.extent.x, measures.extent.y}},
          {"edges", edges}};
}

void say_panel(const Context& context, const Json& panel) {
  int sewn = 0;
  for (const Json& edge : panel["edges"]) sewn += edge["sewn_to"].empty() ? 0 : 1;
  say(context, fmt::format("panel   {}: {:.1f} x {:.1f} cm, {:.4g} m^2, {} of {} edges sewn",
                           panel["name"].get<std::string>(), 100 * panel["extent"][0].get<double>(),
                           100 * panel["extent"][1].get<double>(), panel["area"].get<double>(),
                           sewn, panel["edges"].size()));
}

}  // namespace

void inspect_pattern(const InspectArgs& args, const Context& context) {
  if (!args.against.empty())
    throw UsageError("--against", "the subject is a sewing pattern",
                     "a mesh or an image is wanted");
  if (!args.frame.given.empty())
    throw UsageError(args.frame.given.front(), "the subject is a sewing pattern",
                     "its file says its unit; leave it out");
  const Pattern pattern = read_pattern(args.subject);
  const Partners partners = partners_of(pattern);
  Json panels = Json::array();
  double area = 0;
  for (std::size_t k = 0; k < pattern.panels.size(); ++k) {
    panels.push_back(panel_json(pattern.panels[k], partners[k]));
    area += panels.back()["area"].get<double>();
  }
  for (const std::string& line : pattern.notes) note(context, line);
  say(context, fmt::format("pattern {} panels, {} seams, {:.4g} m^2 of fabric", panels.size(),
                           pattern.stitches.size(), area));
  for (const Json& panel : panels) say_panel(context, panel);
  print_report(context, {{"input", {{"path", args.subject}}},
                         {"pattern",
                          {{"panels", panels}, {"seams", pattern.stitches.size()}, {"area", area}}},
                         {"warnings", pattern.notes},
                         {"outputs", Json::array()}});
}

}  // namespace weft::app
