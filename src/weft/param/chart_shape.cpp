#include "weft/param/chart_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "weft/param/border_curves.h"
#include "weft/param/proxy.h"
#include "weft/param/rotation.h"

namespace weft {
namespace {

constexpr int unit = 4;

int whole_units(double cells) {
  return unit * std::max(1, static_cast<int>(std::lround(cells / unit)));
}

/// Of the rectangle that has the area and the border of a disk; 1 where there is none.
double rectangle_aspect(const CutDisk& cut) {
  double border = 0, area = 0;
  for (const BorderCurve& curve : border_curves(cut)) border += curve.weight * curve.length;
  for (const auto& [a, b, c] : cut.disk.triangles) {
    const Vec3d p = cut.disk.positions[a];
    area += 0.5 * length(cross(cut.disk.positions[b] - p, cut.disk.positions[c] - p));
  }
  const double half = 0.5 * border, square = half * half - 4 * area;
  if (!(square > 0) || !(area > 0)) return 1;
  const double longer = 0.5 * (half + std::sqrt(square));
  return longer * longer / area;
}

}  // namespace

ChartSize chart_size(double cells, double aspect, int max_side) {
  // Where a chart cannot be long enough, it is higher instead, but samples no more than this number
  // of times as densely across as along.
  constexpr double max_density = 1.5;
  const int longest = (max_side - 1) / unit * unit;
  const int longer = std::min(longest, whole_units(std::sqrt(cells * aspect)));
  const int shorter = whole_units(std::min(cells / longer, max_density * longer / aspect));
  return {std::min(longer, std::max(min_shorter(std::sqrt(cells)), shorter)) + 1, longer + 1};
}

int min_shorter(double side) {
  constexpr int of_two_levels = 16;
  return side >= of_two_levels       ? of_two_levels
         : side >= of_two_levels / 2 ? of_two_levels / 2
                                     : unit;
}

CutDisk shape_proxy(const TriangleMesh& mesh, const Cut& cut, const ShapeOptions& options) {
  if (static_cast<int>(mesh.triangles.size()) <= options.proxy_triangles)
    return cut_open(mesh, cut);
  const Proxy proxy = coarsen(mesh, cut, options.proxy_triangles);
  return cut_open(proxy.mesh, proxy.cut);
}

ShapeTrial try_aspect(const CutDisk& cut, double aspect, const ShapeOptions& options) {
  const double least = aspect > 1 ? min_shorter(std::sqrt(options.cells)) : 1;
  const double shorter = std::round(std::max(least, std::sqrt(options.cells / aspect)));
  const ChartSize size{static_cast<int>(shorter) + 1,
                       static_cast<int>(std::lround(shorter * aspect)) + 1};
  if (!has_room(size, cut)) return {aspect};
  const TrialMap trial = try_chart(cut, {size, options.threads, options.progress});
  return {aspect, trial.energy * (size.rows - 1) * (size.cols - 1)};
}

ShapeTrial best_aspect(const CutDisk& cut, const ShapeOptions& options) {
  constexpr double min_aspect = 1.25;
  const double most = rectangle_aspect(cut);
  ShapeTrial best;
  for (const double aspect : {most, std::sqrt(most)}) {
    if (aspect < min_aspect) continue;
    const ShapeTrial trial = try_aspect(cut, aspect, options);
    if (trial.energy < best.energy) best = trial;
  }
  return best;
}

}  // namespace weft
