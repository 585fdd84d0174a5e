#include "weft/param/border_slides.h"

#include <cmath>

#include "weft/param/border_curves.h"

namespace weft {
namespace {

/// Along which axis a side of the square runs, and which way as border positions grow.
struct Side {
  int axis = 0;
  double direction = 1;
};

Side side_at(int size, double t) {
  const int side = static_cast<int>(t / (size - 1));
  return {side % 2, side < 2 ? 1.0 : -1.0};
}

bool is_corner(int size, double t) { return std::fmod(t, size - 1) == 0; }

double& along(Vec2d& point, int axis) { return axis == 0 ? point.x : point.y; }

/// Finds the slides of a cut disk.
struct Finder {
  const CutDisk& cut;
  const BorderLayout& layout;
  std::span<const double> t;

  [[nodiscard]] int size() const { return static_cast<int>(t.size()); }
  /// The way around the border from one border vertex to the next. [sample intervals]
  [[nodiscard]] double gap(int from) const {
    const double way = t[(from + 1) % size()] - t[from];
    return way < 0 ? way + 4.0 * (layout.size - 1) : way;
  }
  [[nodiscard]] bool moves(int border) const {
    constexpr double least_gap = 1e-4;
    return !is_corner(layout.size, t[border]) && gap(border) > least_gap &&
           gap((border + size() - 1) % size()) > least_gap;
  }
  [[nodiscard]] BorderSlide slide_of(int border) const {
    BorderSlide slide;
    slide.vertex = cut.disk.border[border];
    slide.axis = side_at(layout.size, t[border]).axis;
    return slide;
  }
  void join(BorderSlide& slide, int border, int mate) const {
    const Side here = side_at(layout.size, t[border]);
    const Side there = side_at(layout.size, t[mate]);
    Vec2d place = border_point(layout.size, t[border]);
    Vec2d mate_place = border_point(layout.size, t[mate]);
    slide.mate = cut.disk.border[mate];
    slide.mate_axis = there.axis;
    // Mates are walked in opposite directions.
    slide.sign = -here.direction * there.direction;
    slide.offset = along(mate_place, there.axis) - slide.sign * along(place, here.axis);
  }
};

}  // namespace

std::vector<BorderSlide> border_slides(const CutDisk& cut, const BorderLayout& layout,
                                       std::span<const double> t) {
  const Finder finder{cut, layout, t};
  std::vector<BorderSlide> slides;
  for (const BorderCurve& curve : border_curves(cut)) {
    const BorderPath& path = cut.paths[curve.path];
    for (int j = 1; j < path.edges; ++j) {
      const int border = (path.first + j) % finder.size();
      if (!finder.moves(border)) continue;
      BorderSlide slide = finder.slide_of(border);
      if (path.mate >= 0) {
        const int mate = (cut.paths[path.mate].first + path.edges - j) % finder.size();
        if (!finder.moves(mate)) continue;
        finder.join(slide, border, mate);
      }
      slides.push_back(slide);
    }
  }
  return slides;
}

void settle(std::span<const BorderSlide> slides, std::span<Vec2d> uv) {
  constexpr double unit = 0x1p-32;
  for (const BorderSlide& slide : slides) {
    double& place = along(uv[slide.vertex], slide.axis);
    place = std::round(place / unit) * unit;
    if (slide.mate >= 0) along(uv[slide.mate], slide.mate_axis) = slide.offset + slide.sign * place;
  }
}

}  // namespace weft
