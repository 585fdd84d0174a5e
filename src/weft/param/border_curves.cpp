#include "weft/param/border_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "weft/cut/disk_mesh.h"
#include "weft/param/border_layout.h"

namespace weft {

namespace {

/// Minimum share of its path for an edge: an edge of no length would give its triangle no area.
/// Smaller than snap_distance, so that no such edge is ever split.
constexpr double min_share = 1e-8;
/// Places are multiples of this, so that sums and differences with whole numbers are exact.
constexpr double place_unit = 0x1p-32;

/// The vertices of a path as it was before edges of it were split. Where a path is so short that
/// coordinates round by a part of it, the lengths of split edges would not say where they were
/// split.
class UnsplitPath {
 public:
  UnsplitPath(const CutDisk& cut, const BorderPath& path) : disk_(cut.disk) {
    const std::size_t size = disk_.border.size();
    for (int j = 0; j <= path.edges; ++j)
      vertices_.push_back(disk_.border[static_cast<std::size_t>(path.first + j) % size]);
    while (take_last_split()) {
    }
  }

  [[nodiscard]] std::vector<double> edge_lengths() const {
    std::vector<double> lengths;
    for (std::size_t j = 0; j + 1 < vertices_.size(); ++j)
      lengths.push_back(length(disk_.positions[vertices_[j]] - disk_.positions[vertices_[j + 1]]));
    return lengths;
  }
  /// Divides lengths of these edges as they were split.
  void put_splits_back(std::vector<double>& lengths) const {
    for (auto split = splits_.rbegin(); split != splits_.rend(); ++split) {
      const auto second = lengths.begin() + static_cast<std::ptrdiff_t>(split->edge);
      const double whole = *second;
      *second = (1 - split->fraction) * whole;
      lengths.insert(second, split->fraction * whole);
    }
  }

 private:
  struct Split {
    std::size_t edge;
    double fraction;
  };
  [[nodiscard]] bool splits_its_edge(std::size_t j) const {
    const auto v = static_cast<std::size_t>(vertices_[j]);
    if (v >= disk_.split_from.size()) return false;
    const EdgePlace& place = disk_.split_from[v];
    return place.a == vertices_[j - 1] && place.b == vertices_[j + 1];
  }
  bool take_last_split() {
    std::size_t last = 0;
    for (std::size_t j = 1; j + 1 < vertices_.size(); ++j)
      if (splits_its_edge(j) && (last == 0 || vertices_[j] > vertices_[last])) last = j;
    if (last == 0) return false;
    splits_.push_back({last - 1, disk_.split_from[vertices_[last]].fraction});
    vertices_.erase(vertices_.begin() + static_cast<std::ptrdiff_t>(last));
    return true;
  }

  const DiskMesh& disk_;
  std::vector<int> vertices_;
  std::vector<Split> splits_;  // the last first
};

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

/// The surface points at the ends of a path, the lower index first.
std::array<int, 2> end_nodes(const CutDisk& cut, const BorderPath& path) {
  const DiskMesh& disk = cut.disk;
  const int size = static_cast<int>(disk.border.size());
  const int a = disk.surface_vertex[disk.border[path.first]];
  const int b = disk.surface_vertex[disk.border[(path.first + path.edges) % size]];
  return {std::min(a, b), std::max(a, b)};
}

/// Groups the curves by key, shortest first in each group, and visits every group.
template <class Key, class Visit>
void for_each_group(std::vector<BorderCurve>& curves, const Key& key, const Visit& visit) {
  std::vector<int> order(curves.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  const auto rank = [&](int i) { return std::tuple(key(curves[i]), curves[i].length, i); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return rank(a) < rank(b); });
  for (std::size_t first = 0; first < order.size();) {
    std::vector<BorderCurve*> group;
    const auto value = key(curves[order[first]]);
    for (; first < order.size() && key(curves[order[first]]) == value; ++first)
      group.push_back(&curves[order[first]]);
    visit(group);
  }
}

void set_least(const CutDisk& cut, std::vector<BorderCurve>& curves) {
  const auto ends = [&](const BorderCurve& c) { return end_nodes(cut, cut.paths[c.path]); };
  for_each_group(curves, ends, [&](const std::vector<BorderCurve*>& group) {
    const std::array<int, 2> nodes = ends(*group.front());
    const bool closed = nodes[0] == nodes[1];
    for (std::size_t i = 0; i < group.size(); ++i) group[i]->least = closed ? 3 : i > 0 ? 2 : 1;
  });
  const auto loop = [&](const BorderCurve& c) { return cut.paths[c.path].border_loop; };
  for_each_group(curves, loop, [&](const std::vector<BorderCurve*>& group) {
    if (loop(*group.front()) < 0) return;
    int total = 0;
    for (const BorderCurve* curve : group) total += curve->least;
    if (total < 3) group.back()->least += 3 - total;
  });
}

}  // namespace

std::vector<BorderCurve> border_curves(const CutDisk& cut) {
  std::vector<BorderCurve> curves;
  const int count = static_cast<int>(cut.paths.size());
  for (int p = 0; p < count; ++p) {
    const BorderPath& path = cut.paths[p];
    if (path.mate >= 0 && path.mate < p) continue;
    curves.push_back({.path = p,
                      .weight = path.mate >= 0 ? 2 : 1,
                      .length = sum(UnsplitPath(cut, path).edge_lengths()),
                      .least = 1,
                      .fixed = path.intervals});
  }
  set_least(cut, curves);
  // Other charts may join ends of paths that are apart here.
  constexpr int min_beside_shared = 3;
  const bool shares = std::any_of(cut.paths.begin(), cut.paths.end(),
                                  [](const BorderPath& path) { return path.curve >= 0; });
  for (BorderCurve& curve : curves)
    curve.least = curve.fixed > 0 ? curve.fixed
                  : shares        ? std::max(curve.least, min_beside_shared)
                                  : curve.least;
  return curves;
}

std::vector<double> path_places(const CutDisk& cut, int path, int intervals) {
  const UnsplitPath unsplit(cut, cut.paths[path]);
  std::vector<double> lengths = unsplit.edge_lengths();
  const double whole = sum(lengths);
  for (double& l : lengths) l = whole > 0 ? std::max(l, min_share * whole) : 1;
  unsplit.put_splits_back(lengths);
  const double scale = intervals / sum(lengths);
  std::vector<double> places{0};
  double along = 0;
  for (const double l : lengths) {
    along += l;
    const double place = std::round(along * scale / place_unit) * place_unit;
    places.push_back(std::max(place, places.back() + place_unit));
  }
  places.back() = intervals;
  return places;
}

namespace {

/// A border vertex this near to a corner of the chart is the corner. [sample intervals]
constexpr double snap_distance = 1e-3;

/// Positions along a path, in whole intervals, of the corners of the chart strictly inside it or
/// its mate. Ascending, each once.
std::vector<int> corner_places(const CutDisk& cut, const BorderLayout& layout, int path) {
  const int around = layout.size.around();
  const int mate = cut.paths[path].mate;
  const int intervals = layout.intervals[path];
  std::vector<int> places;
  const auto along = [&](int p, int corner) {
    return (corner - layout.first[p] + around) % around;
  };
  for (const int corner : layout.size.corners()) {
    places.push_back(along(path, corner));
    if (mate >= 0) places.push_back(intervals - along(mate, corner));
  }
  std::erase_if(places, [&](int place) { return place <= 0 || place >= intervals; });
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

/// The inner vertex of a path nearest to a position and within snap_distance of it.
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

/// Splits the edge of a path at a position where there is no vertex.
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
  const double around = layout.size.around();
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
