#include "weft/garment/check_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/garment/edge_curve.h"
#include "weft/garment/panel_sides.h"

namespace weft {
namespace {

/// Points of a curved edge that the test for crossings looks at.
constexpr int coarse_parts = 16;
/// Length of an edge over that of the one it is sewn to, at most. Much less cloth is gathered by
/// tailors; beyond it, an edge of samples as dense as the panel's is crushed.
constexpr double max_gathered = 4;

[[noreturn]] void fail(const std::string& place, const std::string& found,
                       const std::string& wanted) {
  throw InputError(place, found, wanted);
}

void check_loop(const Pattern& pattern, int index, const std::string& name) {
  const std::vector<PatternEdge>& edges = pattern.panels[index].edges;
  const int count = static_cast<int>(edges.size());
  if (count < 2)
    fail(fmt::format("{}: panel '{}'", name, pattern.panels[index].name),
         fmt::format("{} edges", count), "an outline of two at least is wanted");
  for (int k = 0; k < count; ++k)
    if (edges[k].to != edges[(k + 1) % count].from)
      fail(place_of(pattern, {index, k}, name),
           fmt::format("an end at vertex {}, where the next edge does not begin", edges[k].to),
           "one closed outline is wanted");
}

/// Removes edges of almost no length. The stitches of the panel follow.
void drop_points(Pattern& pattern, int index) {
  PatternPanel& panel = pattern.panels[index];
  for (int k = static_cast<int>(panel.edges.size()) - 1; k >= 0; --k) {
    const double length = length_of(edge_polyline(panel, panel.edges[k]));
    if (length >= min_edge) continue;
    const int gone = panel.edges[k].to, kept = panel.edges[k].from;
    panel.edges.erase(panel.edges.begin() + k);
    for (PatternEdge& edge : panel.edges) {
      if (edge.from == gone) edge.from = kept;
      if (edge.to == gone) edge.to = kept;
    }
    const std::size_t sewn = std::erase_if(pattern.stitches, [&](const Stitch& s) {
      return (s.a.panel == index && s.a.edge == k) || (s.b.panel == index && s.b.edge == k);
    });
    pattern.notes.push_back(fmt::format("panel '{}', edge {}: left out{}, it is {:.2g} mm long",
                                        panel.name, k, sewn > 0 ? " with its stitch" : "",
                                        1000 * length));
    for (Stitch& stitch : pattern.stitches)
      for (PanelEdge* side : {&stitch.a, &stitch.b})
        if (side->panel == index && side->edge > k) --side->edge;
  }
}

/// Refuses a panel of which too few edges are left.
void check_left(const PatternPanel& panel, const std::string& name) {
  if (panel.edges.size() < 2)
    fail(fmt::format("{}: panel '{}'", name, panel.name),
         fmt::format("an outline of edges shorter than {} mm", 1000 * min_edge),
         "a larger panel is wanted (properties.units_in_meter)");
}

/// Notes arcs whose ends are farther apart than their circle is wide: they become half circles.
/// Rounding by the program that wrote the file is no more than a thousandth.
void note_narrow_circles(Pattern& pattern, int index) {
  const PatternPanel& panel = pattern.panels[index];
  for (std::size_t k = 0; k < panel.edges.size(); ++k) {
    const PatternEdge& edge = panel.edges[k];
    const Vec2d chord = panel.vertices[edge.to] - panel.vertices[edge.from];
    const double half = 0.5 * length(chord);
    if (edge.curve.kind != PatternCurve::Kind::arc || edge.curve.radius > 0.999 * half) continue;
    pattern.notes.push_back(
        fmt::format("panel '{}', edge {}: a half circle of radius {:.3g} mm, as one of {:.3g} mm "
                    "does not reach from end to end",
                    panel.name, k, 1000 * half, 1000 * edge.curve.radius));
  }
}

bool cross_each_other(Vec2d a, Vec2d b, Vec2d c, Vec2d d) {
  const auto side = [](Vec2d p, Vec2d q, Vec2d r) { return cross(q - p, r - p); };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

struct OutlinePiece {
  Vec2d from, to;
  int edge;
};

void check_crossings(const Pattern& pattern, int index, const std::string& name) {
  const PatternPanel& panel = pattern.panels[index];
  std::vector<OutlinePiece> pieces;
  for (std::size_t k = 0; k < panel.edges.size(); ++k) {
    const bool straight = panel.edges[k].curve.kind == PatternCurve::Kind::straight;
    const std::vector<Vec2d> points =
        spread_along(edge_polyline(panel, panel.edges[k]), straight ? 1 : coarse_parts);
    for (std::size_t i = 1; i < points.size(); ++i)
      pieces.push_back({points[i - 1], points[i], static_cast<int>(k)});
  }
  double area = 0;
  for (const OutlinePiece& piece : pieces) area += 0.5 * cross(piece.from, piece.to);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t j = i + 2; j < pieces.size(); ++j)
      if (cross_each_other(pieces[i].from, pieces[i].to, pieces[j].from, pieces[j].to))
        fail(place_of(pattern, {index, pieces[i].edge}, name),
             fmt::format("an outline that crosses itself at edge {}", pieces[j].edge),
             "one without crossings is wanted");
  if (!(std::abs(area) > 1e-8))
    fail(fmt::format("{}: panel '{}'", name, panel.name), "an outline without area",
         "a panel with some is wanted");
}

void check_stitches(const Pattern& pattern, const std::string& name) {
  std::vector<std::array<int, 2>> seen;
  for (const Stitch& stitch : pattern.stitches) {
    const std::array<int, 2> a{stitch.a.panel, stitch.a.edge}, b{stitch.b.panel, stitch.b.edge};
    if (a == b)
      fail(place_of(pattern, stitch.a, name), "a stitch with itself", "two edges are wanted");
    for (const auto& side : {a, b}) {
      if (std::find(seen.begin(), seen.end(), side) != seen.end())
        fail(place_of(pattern, {side[0], side[1]}, name), "two stitches", "one an edge is wanted");
      seen.push_back(side);
    }
  }
}

/// Refuses edges of which one is far longer than the other.
void check_lengths(const Pattern& pattern, const Stitch& stitch, const std::string& name) {
  const auto length = [&](PanelEdge side) {
    const PatternPanel& panel = pattern.panels[side.panel];
    return length_of(edge_polyline(panel, panel.edges[side.edge]));
  };
  double longer = length(stitch.a), shorter = length(stitch.b);
  const PanelEdge place = longer >= shorter ? stitch.a : stitch.b;
  if (longer < shorter) std::swap(longer, shorter);
  if (longer > max_gathered * shorter)
    fail(place_of(pattern, place, name),
         fmt::format("{:.3g} cm sewn to {:.3g} cm", 100 * longer, 100 * shorter),
         fmt::format("an edge at most {:g} times as long as the other is wanted", max_gathered));
}

/// Notes panels that nothing holds: a file may have lost its stitches.
void note_unsewn(Pattern& pattern) {
  std::vector<bool> is_held(pattern.panels.size(), false);
  for (const Stitch& stitch : pattern.stitches)
    is_held[stitch.a.panel] = is_held[stitch.b.panel] = true;
  for (std::size_t k = 0; k < is_held.size(); ++k) {
    const std::vector<PatternEdge>& edges = pattern.panels[k].edges;
    is_held[k] = is_held[k] || std::any_of(edges.begin(), edges.end(), [](const PatternEdge& edge) {
                   return !edge.label.empty();
                 });
  }
  const auto loose = std::count(is_held.begin(), is_held.end(), false);
  if (loose == 0) return;
  const auto first = std::find(is_held.begin(), is_held.end(), false) - is_held.begin();
  pattern.notes.push_back(
      fmt::format("{} of {} panels sewn to nothing and held by no label, the first '{}'", loose,
                  is_held.size(), pattern.panels[static_cast<std::size_t>(first)].name));
}

}  // namespace

std::string place_of(const Pattern& pattern, PanelEdge edge, const std::string& name) {
  return fmt::format("{}: panel '{}', edge {}", name, pattern.panels[edge.panel].name, edge.edge);
}

void check_pattern(Pattern& pattern, const std::string& name) {
  check_stitches(pattern, name);
  for (int k = 0; k < static_cast<int>(pattern.panels.size()); ++k) {
    check_loop(pattern, k, name);
    note_narrow_circles(pattern, k);
    drop_points(pattern, k);
    check_left(pattern.panels[k], name);
    check_crossings(pattern, k, name);
  }
  for (const Stitch& stitch : pattern.stitches) check_lengths(pattern, stitch, name);
  // Refuses what has one side only.
  static_cast<void>(panels_turned(pattern, name));
  note_unsewn(pattern);
}

}  // namespace weft
