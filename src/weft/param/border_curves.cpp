#include "weft/param/border_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace weft {
namespace {

/// The share of its path that an edge counts for at least: an edge of no length would give its
/// triangle no area. Below what a corner is snapped by, so that no such edge is ever split.
constexpr double min_share = 1e-8;
/// Places are multiples of this, so that sums and differences with whole numbers are exact.
constexpr double place_unit = 0x1p-32;

std::vector<double> edge_lengths(const CutDisk& cut, const BorderPath& path) {
  const DiskMesh& disk = cut.disk;
  const int size = static_cast<int>(disk.border.size());
  std::vector<double> lengths(path.edges);
  for (int j = 0; j < path.edges; ++j)
    lengths[j] = length(disk.positions[disk.border[(path.first + j) % size]] -
                        disk.positions[disk.border[(path.first + j + 1) % size]]);
  return lengths;
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

/// The surface points at a path's ends, the lower first.
std::array<int, 2> end_nodes(const CutDisk& cut, const BorderPath& path) {
  const DiskMesh& disk = cut.disk;
  const int size = static_cast<int>(disk.border.size());
  const int a = disk.surface_vertex[disk.border[path.first]];
  const int b = disk.surface_vertex[disk.border[(path.first + path.edges) % size]];
  return {std::min(a, b), std::max(a, b)};
}

/// Puts the curves into groups of equal keys, shortest curve first in each, and visits every group.
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
                      .length = sum(edge_lengths(cut, path)),
                      .least = 1});
  }
  set_least(cut, curves);
  return curves;
}

std::vector<double> path_places(const CutDisk& cut, int path, int intervals) {
  std::vector<double> lengths = edge_lengths(cut, cut.paths[path]);
  const double whole = sum(lengths);
  for (double& l : lengths) l = whole > 0 ? std::max(l, min_share * whole) : 1;
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

}  // namespace weft
