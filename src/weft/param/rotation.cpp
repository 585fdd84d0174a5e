#include "weft/param/rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "weft/param/border_layout.h"
#include "weft/param/chords.h"
#include "weft/param/disk_geometry.h"
#include "weft/param/interior_solver.h"
#include "weft/param/weights.h"

namespace weft {
namespace {

/// The area-weighted mean of the root of the stretch rather than of its square: the first map has a
/// few nearly collapsed triangles that would decide alone by chance, and that later steps open.
double mean_root_stretch(const DiskGeometry& geometry, std::span<const Vec2d> uv) {
  constexpr double collapsed = 1e6;
  double sum = 0;
  for (std::size_t t = 0; t < geometry.surface.size(); ++t) {
    const auto& [a, b, c] = geometry.disk.triangles[t];
    const double square = triangle_stretch(geometry.surface[t], uv[a], uv[b], uv[c]).mean_square;
    sum += geometry.surface[t].area * std::min(std::sqrt(std::sqrt(square)), collapsed);
  }
  return sum;
}

}  // namespace

int choose_rotation(const CutDisk& cut, int size, int count) {
  count = std::min(count, size - 1);
  if (count <= 1) return 0;
  CutDisk trial = cut;
  std::vector<BorderLayout> layouts;
  for (int k = 0; k < count; ++k) {
    layouts.push_back(lay_out_border(cut, {size, k * (size - 1) / count}));
    split_at_corners(trial, layouts.back());
  }
  split_chords(trial.disk);
  const DiskGeometry geometry(trial.disk);
  InteriorSolver solver(trial.disk, geometry.edges);
  if (!solver.factorize_symmetric(symmetric_weights(trial.disk, geometry.edges, geometry.sides)))
    return 0;

  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  std::vector<Vec2d> uv(trial.disk.positions.size());
  for (int k = 0; k < count; ++k) {
    const std::vector<double> t = border_positions(trial, layouts[k]);
    for (std::size_t b = 0; b < t.size(); ++b) uv[trial.disk.border[b]] = border_point(size, t[b]);
    solver.solve_symmetric(uv);
    const double stretch = mean_root_stretch(geometry, uv);
    if (stretch < least) {
      least = stretch;
      best = k * (size - 1) / count;
    }
  }
  return best;
}

}  // namespace weft
