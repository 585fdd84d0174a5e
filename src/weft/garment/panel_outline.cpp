#include "weft/garment/panel_outline.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/garment/check_pattern.h"
#include "weft/garment/edge_curve.h"
#include "weft/garment/panel_sides.h"
#include "weft/garment/rectangle_corners.h"
#include "weft/geometry_image.h"

namespace weft {
namespace {

/// Corners of the pattern lie at multiples of this, so that coarser grids have them, too.
constexpr int unit = 4;

std::vector<std::vector<int>> share_samples(const Pattern& pattern, const std::string& name,
                                            double spacing) {
  // An edge longer than the four sides of the largest image fits round none.
  constexpr int max_samples = 4 * (largest_image_size - 1);
  std::vector<std::vector<double>> wanted;
  for (const PatternPanel& panel : pattern.panels) {
    wanted.emplace_back();
    for (const PatternEdge& edge : panel.edges)
      wanted.back().push_back(length_of(edge_polyline(panel, edge)) / spacing);
  }
  for (const Stitch& s : pattern.stitches) {
    double &a = wanted[s.a.panel][s.a.edge], &b = wanted[s.b.panel][s.b.edge];
    a = b = std::max(a, b);
  }
  std::vector<std::vector<int>> intervals;
  for (std::size_t p = 0; p < wanted.size(); ++p) {
    intervals.emplace_back();
    for (std::size_t k = 0; k < wanted[p].size(); ++k) {
      if (wanted[p][k] > max_samples)
        throw InputError(place_of(pattern, {static_cast<int>(p), static_cast<int>(k)}, name),
                         fmt::format("{:.3g} samples", wanted[p][k]), "a wider spacing is wanted");
      intervals.back().push_back(unit *
                                 std::max(1, static_cast<int>(std::lround(wanted[p][k] / unit))));
    }
  }
  // A rectangle has two samples a side at least in every direction.
  for (std::vector<int>& panel : intervals)
    while (std::accumulate(panel.begin(), panel.end(), 0) < 4 * unit) panel.front() += unit;
  return intervals;
}

PanelOutline walk(const PatternPanel& panel, const std::vector<int>& intervals, bool turned) {
  PanelOutline outline;
  const int count = static_cast<int>(panel.edges.size());
  outline.first.resize(panel.edges.size());
  outline.intervals = intervals;
  for (int i = 0; i < count; ++i) {
    const int k = turned ? count - 1 - i : i;
    std::vector<Vec2d> points = spread_along(edge_polyline(panel, panel.edges[k]), intervals[k]);
    if (turned) std::reverse(points.begin(), points.end());
    outline.first[k] = static_cast<int>(outline.points.size());
    outline.points.insert(outline.points.end(), points.begin(), points.end() - 1);
  }
  double area = 0;
  for (std::size_t i = 0; i < outline.points.size(); ++i)
    area += cross(outline.points[i], outline.points[(i + 1) % outline.points.size()]);
  outline.mirrored = area < 0;
  return outline;
}

}  // namespace

std::vector<Vec2d> PanelOutline::border_from(int point) const {
  std::vector<Vec2d> border;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec2d p = points[(static_cast<std::size_t>(point) + k) % points.size()];
    border.push_back({mirrored ? -p.x : p.x, p.y});
  }
  return border;
}

std::vector<PanelOutline> lay_outlines(const Pattern& pattern, const std::string& name,
                                       double spacing, Progress* progress) {
  const std::vector<bool> turned = panels_turned(pattern, name);
  const std::vector<std::vector<int>> intervals = share_samples(pattern, name, spacing);
  std::vector<PanelOutline> outlines;
  // Grids come next and take as long.
  const double whole = 0.5 / static_cast<double>(pattern.panels.size());
  for (std::size_t p = 0; p < pattern.panels.size(); ++p) {
    outlines.push_back(walk(pattern.panels[p], intervals[p], turned[p]));
    PartOfProgress part(progress, "lay panels", whole * static_cast<double>(p), 1);
    choose_corners(outlines.back(), &part);
  }
  return outlines;
}

}  // namespace weft
