#include <algorithm>
#include <cmath>
#include <optional>

#include "weft/cut/split_border_edge.h"
#include "weft/param/border_curves.h"
#include "weft/param/border_layout.h"

namespace weft {
namespace {

/// A border vertex this near to a corner, in sample intervals, is the corner.
constexpr double snap_distance = 1e-3;

/// Where corners of the square fall strictly inside a curve, as whole places along its path; those
/// that its mate meets are counted too. Ascending, each once.
std::vector<int> corner_places(const CutDisk& cut, const BorderLayout& layout, int path) {
  const int side = layout.size - 1;
  const int mate = cut.paths[path].mate;
  const int intervals = layout.intervals[path];
  std::vector<int> places;
  const auto along = [&](int p, int corner) {
    return (corner * side - layout.first[p] + 4 * side) % (4 * side);
  };
  for (int corner = 0; corner < 4; ++corner) {
    places.push_back(along(path, corner));
    if (mate >= 0) places.push_back(intervals - along(mate, corner));
  }
  std::erase_if(places, [&](int place) { return place <= 0 || place >= intervals; });
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

/// The inner vertex of a path nearest to a place, when it is near enough to take it.
std::optional<int> vertex_at(const std::vector<double>& places, double place) {
  const int last = static_cast<int>(places.size()) - 1;
  std::optional<int> nearest;
  for (int j = 1; j < last; ++j) {
    const double distance = std::abs(places[j] - place);
    if (distance > snap_distance) continue;
    if (!nearest || distance < std::abs(places[*nearest] - place)) nearest = j;
  }
  return nearest;
}

/// Splits the edge in which a place of the path falls, if no vertex is there.
void split_at(CutDisk& cut, int path, int intervals, double place) {
  const std::vector<double> places = path_places(cut, path, intervals);
  if (vertex_at(places, place)) return;
  const auto after = std::upper_bound(places.begin(), places.end(), place);
  const int edge = static_cast<int>(after - places.begin()) - 1;
  const double fraction = (place - places[edge]) / (places[edge + 1] - places[edge]);
  const int size = static_cast<int>(cut.disk.border.size());
  split_border_edge(cut, (cut.paths[path].first + edge) % size, fraction);
}

}  // namespace

void split_at_corners(CutDisk& cut, const BorderLayout& layout) {
  for (const BorderCurve& curve : border_curves(cut))
    for (const int place : corner_places(cut, layout, curve.path))
      split_at(cut, curve.path, layout.intervals[curve.path], place);
}

std::vector<double> border_positions(const CutDisk& cut, const BorderLayout& layout) {
  const int size = static_cast<int>(cut.disk.border.size());
  const double around = 4.0 * (layout.size - 1);
  std::vector<double> positions(size, 0);
  const auto put = [&](int path, int j, double place) {
    const double t = layout.first[path] + place;
    positions[(cut.paths[path].first + j) % size] = t < around ? t : t - around;
  };
  for (const BorderCurve& curve : border_curves(cut)) {
    const BorderPath& path = cut.paths[curve.path];
    const int intervals = layout.intervals[curve.path];
    std::vector<double> places = path_places(cut, curve.path, intervals);
    for (const int corner : corner_places(cut, layout, curve.path))
      if (const std::optional<int> j = vertex_at(places, corner)) places[*j] = corner;
    for (int j = 0; j < path.edges; ++j) put(curve.path, j, places[j]);
    if (path.mate < 0) continue;
    for (int j = 0; j < path.edges; ++j) put(path.mate, j, intervals - places[path.edges - j]);
  }
  return positions;
}

}  // namespace weft
