#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/core/json.h"
#include "weft/core/math.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/garment.h"
#include "weft/garment/check_pattern.h"

namespace weft {
namespace {

using nlohmann::json;

constexpr int deepest = 32;
/// How large a panel may be, and how far away it may be placed. Patterns in centimetres that are
/// read as metres are larger. [m]
constexpr double largest_panel = 20, farthest_place = 100;
/// Of an arc that is nearly straight. [m]
constexpr double largest_radius = 1e5;

/// A value of the file and where it lies.
struct Node {
  const json& value;
  std::string place;

  [[noreturn]] void fail(const std::string& found, const std::string& wanted) const {
    throw InputError(place, found, wanted);
  }
  [[nodiscard]] Node at(const std::string& key) const {
    if (!value.is_object() || !value.contains(key))
      fail(fmt::format("no '{}'", key), "a GarmentCode pattern is wanted");
    return {value[key], fmt::format("{}: {}", place, key)};
  }
  [[nodiscard]] Node named(const std::string& what, std::size_t index) const {
    return {value[index], fmt::format("{}: {} {}", place, what, index)};
  }
  [[nodiscard]] const Node& list(std::size_t count) const {
    if (!value.is_array() || (count > 0 && value.size() != count))
      fail("no list of that kind",
           count > 0 ? fmt::format("a list of {} is wanted", count) : "a list is wanted");
    return *this;
  }
  [[nodiscard]] double number() const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail("no number", "a finite number is wanted");
    return value.get<double>();
  }
  [[nodiscard]] Vec2d pair() const {
    static_cast<void>(list(2));
    return {Node{value[0], place}.number(), Node{value[1], place}.number()};
  }
  [[nodiscard]] Vec3d triple() const {
    static_cast<void>(list(3));
    return {Node{value[0], place}.number(), Node{value[1], place}.number(),
            Node{value[2], place}.number()};
  }
  [[nodiscard]] int index(std::size_t count, const std::string& of) const {
    if (!value.is_number_integer() || value.get<long long>() < 0 ||
        value.get<long long>() >= static_cast<long long>(count))
      fail(fmt::format("{}", json_text(value)),
           fmt::format("one of the {} {} is wanted", count, of));
    return value.get<int>();
  }
  [[nodiscard]] std::string text_or_none(const std::string& key) const {
    if (!value.contains(key) || value[key].is_null()) return {};
    if (!value[key].is_string()) fail(fmt::format("'{}' that is no text", key), "a text is wanted");
    return value[key].get<std::string>();
  }
};

/// Refuses a point that is farther from its panel's origin than panels are large.
void check_reach(const Node& node, const std::string& what, Vec2d p) {
  const double away = length(p);
  if (away > largest_panel)
    node.fail(fmt::format("{} {:.3g} m away", what, away),
              fmt::format("a panel of at most {} m is wanted (properties.units_in_meter)",
                          largest_panel));
}

/// What the numbers of a file mean.
struct Coordinates {
  double unit = 0.01;                     // [m]
  bool controls_are_beside_edges = true;  // or in the panel's own axes
};

/// A control point, given along the chord and to the left of it, in chord lengths, or in its panel.
Vec2d control_point(Vec2d from, Vec2d to, Vec2d given, const Coordinates& coordinates) {
  if (!coordinates.controls_are_beside_edges) return coordinates.unit * given;
  const Vec2d chord = to - from;
  return from + given.x * chord + given.y * Vec2d{-chord.y, chord.x};
}

PatternCurve read_curve(const Node& node, Vec2d from, Vec2d to, const Coordinates& coordinates) {
  PatternCurve curve;
  if (node.value.is_array()) {  // of older files
    curve.kind = PatternCurve::Kind::bezier;
    curve.controls = {control_point(from, to, node.pair(), coordinates)};
    return curve;
  }
  const std::string type = node.value.is_object() ? node.text_or_none("type") : "";
  const Node params = node.at("params");
  if (type == "circle") {
    static_cast<void>(params.list(3));
    curve.kind = PatternCurve::Kind::arc;
    curve.radius = coordinates.unit * params.named("value", 0).number();
    curve.large = params.named("value", 1).number() != 0;
    curve.counterclockwise = params.named("value", 2).number() != 0;
    if (!(curve.radius > 0) || curve.radius > largest_radius)
      params.fail(fmt::format("a circle of radius {:.3g} m", curve.radius),
                  "a positive one is wanted");
    return curve;
  }
  if (type != "quadratic" && type != "cubic")
    node.fail(fmt::format("a curve of the kind '{}'", type),
              "quadratic, cubic or circle is wanted");
  const std::size_t count = type == "cubic" ? 2 : 1;
  curve.kind = PatternCurve::Kind::bezier;
  for (std::size_t k = 0; k < params.list(count).value.size(); ++k)
    curve.controls.push_back(control_point(from, to, params.named("value", k).pair(), coordinates));
  return curve;
}

PatternPanel read_panel(const Node& node, const std::string& name, const Coordinates& coordinates) {
  const double unit = coordinates.unit;
  PatternPanel panel{name, node.text_or_none("label"), {}, {}, {}, {}};
  const Node vertices = node.at("vertices");
  for (std::size_t k = 0; k < vertices.list(0).value.size(); ++k) {
    const Vec2d p = unit * vertices.named("vertex", k).pair();
    check_reach(vertices, "a vertex", p);
    panel.vertices.push_back(p);
  }
  const Node edges = node.at("edges");
  for (std::size_t k = 0; k < edges.list(0).value.size(); ++k) {
    const Node one{edges.value[k], fmt::format("{}: edge {}", node.place, k)};
    const Node ends = one.at("endpoints").list(2);
    PatternEdge edge;
    edge.from = ends.named("end", 0).index(panel.vertices.size(), "vertices");
    edge.to = ends.named("end", 1).index(panel.vertices.size(), "vertices");
    edge.label = one.text_or_none("label");
    if (one.value.contains("curvature") && !one.value["curvature"].is_null())
      edge.curve = read_curve(one.at("curvature"), panel.vertices[edge.from],
                              panel.vertices[edge.to], coordinates);
    for (const Vec2d& p : edge.curve.controls)
      check_reach(one.at("curvature"), "a control point", p);
    panel.edges.push_back(std::move(edge));
  }
  if (node.value.contains("rotation")) panel.rotate = node.at("rotation").triple();
  if (node.value.contains("translation")) {
    panel.translate = unit * node.at("translation").triple();
    if (length(panel.translate) > farthest_place)
      node.at("translation")
          .fail(fmt::format("a panel {:.3g} m away", length(panel.translate)),
                fmt::format("one of at most {} m is wanted", farthest_place));
  }
  return panel;
}

Coordinates coordinates_of(const Node& file) {
  Coordinates coordinates;
  if (!file.value.contains("properties")) return coordinates;
  const Node properties = file.at("properties");
  if (properties.value.contains("units_in_meter")) {
    const Node units = properties.at("units_in_meter");
    const double count = units.number();
    if (!(count > 0)) units.fail(fmt::format("{}", count), "a number above 0 is wanted");
    coordinates.unit = 1 / count;
  }
  const std::string curves = properties.text_or_none("curvature_coords");
  coordinates.controls_are_beside_edges = curves != "absolute";
  if (!curves.empty() && curves != "absolute" && curves != "relative")
    properties.at("curvature_coords")
        .fail(fmt::format("'{}'", curves), "relative or absolute is wanted");
  return coordinates;
}

PanelEdge read_side(const Node& node, const Pattern& pattern,
                    const std::map<std::string, int>& panel_by_name) {
  const std::string name = node.value.is_object() ? node.text_or_none("panel") : "";
  const auto found = panel_by_name.find(name);
  if (found == panel_by_name.end())
    node.fail(fmt::format("panel '{}', which there is not", name),
              "a panel of the pattern is wanted");
  const Node edge{node.at("edge").value, fmt::format("{}: panel '{}', edge", node.place, name)};
  return {found->second, edge.index(pattern.panels[found->second].edges.size(), "edges")};
}

Stitch read_stitch(const Node& node, const Pattern& pattern,
                   const std::map<std::string, int>& panel_by_name) {
  if (!node.value.is_array() || node.value.size() < 2 || node.value.size() > 3)
    node.fail("no pair of edges", "two edges are wanted");
  Stitch stitch{read_side({node.value[0], node.place}, pattern, panel_by_name),
                read_side({node.value[1], node.place}, pattern, panel_by_name)};
  if (node.value.size() == 3) {
    if (node.value[2] != "right_wrong")
      node.fail(json_text(node.value[2]), "\"right_wrong\" is wanted");
    stitch.turned = true;
  }
  return stitch;
}

/// Keys of panels and of their edges.
constexpr std::array panel_keys{"translation", "rotation", "vertices", "edges", "label"};
constexpr std::array edge_keys{"endpoints", "curvature", "label"};
constexpr std::size_t most_notes = 8;  // of keys: a file may have any number

/// Notes the keys of an object that nothing reads, each once: one may be meant for another.
void note_unknown(const json& object, std::span<const char* const> known, const std::string& place,
                  std::vector<std::string>& notes) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string note = fmt::format("key {} is not known", json_text(json(key)));
    const auto same = [&](const std::string& told) { return told.ends_with(note); };
    if (notes.size() < most_notes && std::none_of(notes.begin(), notes.end(), same))
      notes.push_back(fmt::format("{}: {}", place, note));
  }
}

void note_unknown_keys(const std::string& name, const json& panel, Pattern& pattern) {
  note_unknown(panel, panel_keys, fmt::format("panel '{}'", name), pattern.notes);
  for (std::size_t k = 0; k < panel["edges"].size(); ++k)
    note_unknown(panel["edges"][k], edge_keys, fmt::format("panel '{}', edge {}", name, k),
                 pattern.notes);
}

}  // namespace

Vec3d PatternPanel::placed(Vec2d point) const {
  constexpr double degree = pi / 180;
  Vec3d p{point.x, point.y, 0};
  const double cx = cosine(degree * rotate.x), sx = sine(degree * rotate.x);
  const double cy = cosine(degree * rotate.y), sy = sine(degree * rotate.y);
  const double cz = cosine(degree * rotate.z), sz = sine(degree * rotate.z);
  p = {p.x, cx * p.y - sx * p.z, sx * p.y + cx * p.z};
  p = {cy * p.x + sy * p.z, p.y, -sy * p.x + cy * p.z};
  p = {cz * p.x - sz * p.y, sz * p.x + cz * p.y, p.z};
  return p + translate;
}

bool is_pattern_name(std::string_view name) { return ending_of(std::string(name)) == ".json"; }

Pattern parse_pattern(std::string_view text, const std::string& name) {
  json file;
  try {
    file = parse_json(text, deepest);
  } catch (const JsonFault& fault) {
    throw InputError(fault.place(name), fault.what(), fault.wanted("a sewing pattern is wanted"));
  }
  const Node whole{file, name};
  const Node body = whole.at("pattern");
  const Coordinates coordinates = coordinates_of(whole);
  Pattern pattern;
  std::map<std::string, int> panel_by_name;
  const Node panels = body.at("panels");
  if (!panels.value.is_object() || panels.value.empty())
    panels.fail("no panels", "one at least is wanted");
  for (const auto& [key, value] : panels.value.items()) {
    panel_by_name[key] = static_cast<int>(pattern.panels.size());
    pattern.panels.push_back(
        read_panel({value, fmt::format("{}: panel '{}'", name, key)}, key, coordinates));
    note_unknown_keys(key, value, pattern);
  }
  if (body.value.contains("stitches"))
    for (std::size_t k = 0; k < body.at("stitches").list(0).value.size(); ++k)
      pattern.stitches.push_back(
          read_stitch({body.value["stitches"][k], fmt::format("{}: stitch {}", name, k)}, pattern,
                      panel_by_name));
  check_pattern(pattern, name);
  return pattern;
}

Pattern read_pattern(const std::string& path) { return parse_pattern(read_file(path), path); }

}  // namespace weft
