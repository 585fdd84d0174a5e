#include "weft/garment/edge_curve.h"

#include <algorithm>
#include <cmath>

#include "weft/core/math.h"

namespace weft {
namespace {

/// Pieces of a curved edge's polyline.
constexpr int fine = 256;

Vec2d on_bezier(Vec2d from, const std::vector<Vec2d>& controls, Vec2d to, double t) {
  const double s = 1 - t;
  if (controls.size() == 1) return s * s * from + 2 * s * t * controls[0] + t * t * to;
  return s * s * s * from + 3 * s * s * t * controls[0] + 3 * s * t * t * controls[1] +
         t * t * t * to;
}

/// The arc's centre lies at right angles to the chord's middle: to the left of it where a short arc
/// is walked counter-clockwise or a long one clockwise.
std::vector<Vec2d> arc(Vec2d from, Vec2d to, const PatternCurve& curve) {
  const Vec2d chord = to - from;
  const double half = 0.5 * length(chord);
  const double radius = std::max(curve.radius, half);  // rounding of half circles
  const double away = std::sqrt(std::max(0.0, radius * radius - half * half)) / (2 * half);
  const double side = curve.counterclockwise != curve.large ? 1 : -1;
  const Vec2d centre = from + 0.5 * chord + side * away * Vec2d{-chord.y, chord.x};
  const double first = arc_tangent(from.y - centre.y, from.x - centre.x);
  double turn = arc_tangent(to.y - centre.y, to.x - centre.x) - first;
  const double whole = 2 * pi;
  if (curve.counterclockwise && turn <= 0) turn += whole;
  if (!curve.counterclockwise && turn >= 0) turn -= whole;
  std::vector<Vec2d> points;
  for (int k = 0; k <= fine; ++k) {
    const double angle = first + turn * k / fine;
    points.push_back(centre + radius * Vec2d{cosine(angle), sine(angle)});
  }
  points.front() = from;
  points.back() = to;
  return points;
}

}  // namespace

std::vector<Vec2d> edge_polyline(const PatternPanel& panel, const PatternEdge& edge) {
  const Vec2d from = panel.vertices[edge.from], to = panel.vertices[edge.to];
  if (edge.curve.kind == PatternCurve::Kind::straight) return {from, to};
  if (edge.curve.kind == PatternCurve::Kind::arc) return arc(from, to, edge.curve);
  std::vector<Vec2d> points;
  for (int k = 0; k <= fine; ++k)
    points.push_back(on_bezier(from, edge.curve.controls, to, static_cast<double>(k) / fine));
  return points;
}

double length_of(const std::vector<Vec2d>& polyline) {
  double sum = 0;
  for (std::size_t k = 1; k < polyline.size(); ++k) sum += length(polyline[k] - polyline[k - 1]);
  return sum;
}

std::vector<Vec2d> spread_along(const std::vector<Vec2d>& polyline, int intervals) {
  const double whole = length_of(polyline);
  std::vector<Vec2d> points{polyline.front()};
  double before = 0;
  std::size_t piece = 1;
  for (int k = 1; k < intervals; ++k) {
    const double wanted = whole * k / intervals;
    double here = 0;
    for (; piece < polyline.size(); ++piece) {
      const Vec2d step = polyline[piece] - polyline[piece - 1];
      here = length(step);
      if (before + here >= wanted || piece + 1 == polyline.size()) break;
      before += here;
    }
    const double part = here > 0 ? (wanted - before) / here : 0;
    points.push_back(polyline[piece - 1] + part * (polyline[piece] - polyline[piece - 1]));
  }
  points.push_back(polyline.back());
  return points;
}

}  // namespace weft
