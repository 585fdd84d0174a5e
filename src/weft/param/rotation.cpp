#include "weft/param/rotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "weft/param/proxy.h"

namespace weft {
namespace {

constexpr int max_triangles = 2000;

/// The surface before it was cut open, and the cut on it.
struct Surface {
  TriangleMesh mesh;
  Cut cut;
};

Surface closed(const CutDisk& cut) {
  const DiskMesh& disk = cut.disk;
  Surface surface;
  for (std::size_t v = 0; v < disk.positions.size(); ++v) {
    const auto id = static_cast<std::size_t>(disk.surface_vertex[v]);
    if (id >= surface.mesh.positions.size()) surface.mesh.positions.resize(id + 1);
    surface.mesh.positions[id] = disk.positions[v];
  }
  surface.mesh.triangles = disk.triangles;
  for (Triangle& t : surface.mesh.triangles)
    for (int& corner : t) corner = disk.surface_vertex[corner];
  const std::size_t size = disk.border.size();
  for (int p = 0; p < static_cast<int>(cut.paths.size()); ++p) {
    if (cut.paths[p].mate <= p) continue;
    for (int j = 0; j < cut.paths[p].edges; ++j) {
      const std::size_t first = static_cast<std::size_t>(cut.paths[p].first) + j;
      const int a = disk.surface_vertex[disk.border[first % size]];
      const int b = disk.surface_vertex[disk.border[(first + 1) % size]];
      surface.cut.edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(surface.cut.edges.begin(), surface.cut.edges.end());
  return surface;
}

/// Distance between two positions along the border, the shorter way around.
double apart(double a, double b, double around) {
  const double distance = std::fmod(std::abs(a - b), around);
  return std::min(distance, around - distance);
}

/// Transfers a border rotation from a coarsened disk to the fine one: to the rotation that puts the
/// nodes nearest to those of the coarse disk.
struct Transfer {
  const CutDisk& fine;
  const CutDisk& coarse;
  const std::vector<int>& source_vertex;
  ChartSize size;

  [[nodiscard]] int rotation(int of_coarse, int step) const {
    const double around = size.around();
    const std::vector<double> t = border_positions(fine, lay_out_border(fine, {size, 0}));
    const std::vector<int> wanted = lay_out_border(coarse, {size, of_coarse}).first;
    double min = std::numeric_limits<double>::infinity();
    double best = 0;
    for (const double candidate : places_of(0, t)) {
      const double shift = wanted[0] - candidate;
      double sum = 0;
      for (std::size_t p = 0; p < wanted.size(); ++p) {
        double nearest = around;
        for (const double place : places_of(p, t))
          nearest = std::min(nearest, apart(place + shift, wanted[p], around));
        sum += nearest;
      }
      if (sum >= min) continue;
      min = sum;
      best = shift;
    }
    return static_cast<int>(std::round(best / step)) * step;
  }

  /// Border positions on the fine disk of a coarse path's first node, one for each of its seam
  /// copies.
  [[nodiscard]] std::vector<double> places_of(std::size_t path,
                                              const std::vector<double>& t) const {
    const int node = coarse.disk.border[coarse.paths[path].first];
    const int surface_vertex = source_vertex[coarse.disk.surface_vertex[node]];
    std::vector<double> places;
    for (std::size_t b = 0; b < t.size(); ++b)
      if (fine.disk.surface_vertex[fine.disk.border[b]] == surface_vertex) places.push_back(t[b]);
    return places;
  }
};

/// Small against the shorter side.
int rotation_step(const RotationOptions& options) {
  const auto [rows, cols] = options.size;
  const int step = std::max(1, (std::min(rows, cols) - 1) / (2 * options.count));
  return step < options.unit ? 1 : step / options.unit * options.unit;
}

TrialMap try_square(const CutDisk& cut, const RotationOptions& wanted) {
  const int step = rotation_step(wanted);
  const TrialOptions options{.size = wanted.size, .threads = wanted.threads};
  std::vector<int> rotations;
  for (int k = 0; k < wanted.count; ++k) rotations.push_back(2 * k * step);
  const TrialMap best = try_rotations(cut, rotations, options);
  const std::vector<int> near = {best.rotation - step, best.rotation + step};
  const TrialMap refined = try_rotations(cut, near, options);
  return refined.energy < best.energy ? refined : best;
}

/// The points of the surface at the border positions k * stride of rotation 0.
std::vector<Vec3d> points_around(const CutDisk& cut, ChartSize size, int stride) {
  const DiskMesh& disk = cut.disk;
  const std::vector<double> t = border_positions(cut, lay_out_border(cut, {size, 0}));
  const int around = size.around();
  std::vector<Vec3d> points(static_cast<std::size_t>(around / stride));
  for (std::size_t b = 0; b < t.size(); ++b) {
    const std::size_t next = (b + 1) % t.size();
    const double end = t[next] > t[b] ? t[next] : t[next] + around;
    const Vec3d from = disk.positions[disk.border[b]], to = disk.positions[disk.border[next]];
    for (int k = static_cast<int>(std::ceil(t[b] / stride)); k * stride < end; ++k)
      points[k % points.size()] = from + (k * stride - t[b]) / (end - t[b]) * (to - from);
  }
  return points;
}

/// Rotations over half the border: one that puts the ends of the chart at the flattest fold, and
/// others evenly spread from there.
std::vector<int> rectangle_rotations(const CutDisk& cut, ChartSize size, int count, int step) {
  const int half = size.around() / 2;
  const int end = size.cols > size.rows ? size.cols - 1 + (size.rows - 1) / 2 : (size.cols - 1) / 2;
  const double first = end - flattest_fold(cut, size);
  std::vector<int> rotations;
  for (int k = 0; k < count; ++k)
    rotations.push_back(static_cast<int>(std::lround((first + k * half / count) / step)) * step);
  return rotations;
}

TrialMap try_rectangle(const CutDisk& cut, const RotationOptions& wanted) {
  const ChartSize size = wanted.size;
  const int step = rotation_step(wanted);
  const TrialOptions options{.size = size, .threads = wanted.threads};
  TrialMap best = try_rotations(cut, rectangle_rotations(cut, size, wanted.count, step), options);
  for (int steps = size.around() / 4 / wanted.count / step; steps > 0; steps /= 2) {
    const int apart = steps * step;
    TrialMap near =
        try_rotations(cut, std::vector{best.rotation - apart, best.rotation + apart}, options);
    if (near.energy < best.energy) best = std::move(near);
  }
  return best;
}

}  // namespace

int flattest_fold(const CutDisk& cut, ChartSize size) {
  constexpr int max_points = 512;
  const int stride = (size.around() + max_points - 1) / max_points;
  const std::vector<Vec3d> points = points_around(cut, size, stride);
  const std::size_t count = points.size();
  double min = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  for (std::size_t fold = 0; fold < count / 2; ++fold) {
    double sum = 0;
    for (std::size_t k = 1; k < count / 2; ++k)
      sum += squared_length(points[(fold + k) % count] - points[(fold + count - k) % count]);
    if (sum >= min) continue;
    min = sum;
    best = fold;
  }
  return static_cast<int>(best) * stride;
}

TrialMap try_chart(const CutDisk& cut, const TrialOptions& options) {
  constexpr int count = 4;
  const ChartSize size = options.size;
  if (!size.is_square())
    return try_rotations(cut, rectangle_rotations(cut, size, count, 1), options);
  const int step = std::max(1, (size.rows - 1) / count);
  return try_rotations(cut, std::array{0, step, 2 * step, 3 * step}, options);
}

int choose_rotation(const CutDisk& cut, RotationOptions options) {
  const ChartSize size = options.size;
  if (size.is_square()) options.count = std::min(options.count, (size.rows - 1) / 2);
  if (options.count <= 1) return 0;
  const auto best = [&](const CutDisk& disk) {
    return (size.is_square() ? try_square(disk, options) : try_rectangle(disk, options)).rotation;
  };
  if (static_cast<int>(cut.disk.triangles.size()) <= max_triangles) return best(cut);
  const Surface surface = closed(cut);
  const Proxy proxy = coarsen(surface.mesh, surface.cut, max_triangles);
  const CutDisk coarse = cut_open(proxy.mesh, proxy.cut);
  const Transfer transfer{cut, coarse, proxy.source_vertex, size};
  return transfer.rotation(best(coarse), rotation_step(options));
}

}  // namespace weft
