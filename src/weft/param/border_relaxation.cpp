#include "weft/param/border_relaxation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "weft/param/border_curves.h"

namespace weft {
namespace {

/// The axis of a side of the chart, and its direction with growing border positions.
struct Side {
  int axis = 0;
  double direction = 1;
};

Side side_at(ChartSize size, double t) {
  const std::array<int, 4> corners = size.corners();
  const auto side = std::upper_bound(corners.begin(), corners.end(), t) - corners.begin() - 1;
  return {static_cast<int>(side % 2), side < 2 ? 1.0 : -1.0};
}

bool is_corner(ChartSize size, double t) {
  const std::array<int, 4> corners = size.corners();
  return std::find(corners.begin(), corners.end(), t) != corners.end();
}

double& along(Vec2d& point, int axis) { return axis == 0 ? point.x : point.y; }

/// Finds the freedoms of a cut disk.
struct Finder {
  const CutDisk& cut;
  const BorderLayout& layout;
  std::span<const double> t;

  [[nodiscard]] int size() const { return static_cast<int>(t.size()); }
  /// Distance along the border from one border vertex to the next. [sample intervals]
  [[nodiscard]] double gap(int from) const {
    const double distance = t[(from + 1) % size()] - t[from];
    return distance < 0 ? distance + layout.size.around() : distance;
  }
  [[nodiscard]] bool moves(int border) const {
    constexpr double min_gap = 1e-4;
    return !is_corner(layout.size, t[border]) && gap(border) > min_gap &&
           gap((border + size() - 1) % size()) > min_gap;
  }
  [[nodiscard]] BorderFreedom freedom_of(int border) const {
    BorderFreedom freedom;
    freedom.vertex = cut.disk.border[border];
    freedom.axis = side_at(layout.size, t[border]).axis;
    return freedom;
  }
  void join(BorderFreedom& freedom, int border, int mate) const {
    const Side here = side_at(layout.size, t[border]);
    const Side there = side_at(layout.size, t[mate]);
    Vec2d place = border_point(layout.size, t[border]);
    Vec2d mate_place = border_point(layout.size, t[mate]);
    freedom.mate = cut.disk.border[mate];
    freedom.mate_axis = there.axis;
    // Mates run in opposite directions.
    freedom.sign = -here.direction * there.direction;
    freedom.offset = along(mate_place, there.axis) - freedom.sign * along(place, here.axis);
  }
};

}  // namespace

std::vector<BorderFreedom> border_freedoms(const CutDisk& cut, const BorderLayout& layout,
                                           std::span<const double> t) {
  const Finder finder{cut, layout, t};
  std::vector<BorderFreedom> freedoms;
  for (const BorderCurve& curve : border_curves(cut)) {
    const BorderPath& path = cut.paths[curve.path];
    // Other charts sample it by arc length, too.
    if (path.intervals > 0) continue;
    for (int j = 1; j < path.edges; ++j) {
      const int border = (path.first + j) % finder.size();
      if (!finder.moves(border)) continue;
      BorderFreedom freedom = finder.freedom_of(border);
      if (path.mate >= 0) {
        const int mate = (cut.paths[path.mate].first + path.edges - j) % finder.size();
        if (!finder.moves(mate)) continue;
        finder.join(freedom, border, mate);
      }
      freedoms.push_back(freedom);
    }
  }
  return freedoms;
}

void snap_to_grid(std::span<const BorderFreedom> freedoms, std::span<Vec2d> uv) {
  constexpr double unit = 0x1p-32;
  for (const BorderFreedom& freedom : freedoms) {
    double& place = along(uv[freedom.vertex], freedom.axis);
    place = std::round(place / unit) * unit;
    if (freedom.mate >= 0)
      along(uv[freedom.mate], freedom.mate_axis) = freedom.offset + freedom.sign * place;
  }
}

}  // namespace weft
