#include "weft/param/rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "weft/param/border_layout.h"
#include "weft/param/proxy.h"
#include "weft/param/trial_map.h"

namespace weft {
namespace {

constexpr int max_triangles = 2000;

/// The surface that was cut, whole again.
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

/// Distance around the border.
double apart(double a, double b, double around) {
  const double distance = std::fmod(std::abs(a - b), around);
  return std::min(distance, around - distance);
}

/// The rotation of a disk under which its nodes lie where those of its coarser self do.
struct Transfer {
  const CutDisk& fine;
  const CutDisk& coarse;
  const std::vector<int>& source_vertex;
  int size;

  [[nodiscard]] int rotation(int of_coarse, int step) const {
    const double around = 4.0 * (size - 1);
    const std::vector<double> t = border_positions(fine, lay_out_border(fine, {size, 0}));
    const std::vector<int> wanted = lay_out_border(coarse, {size, of_coarse}).first;
    double least = std::numeric_limits<double>::infinity();
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
      if (sum >= least) continue;
      least = sum;
      best = shift;
    }
    return static_cast<int>(std::round(best / step)) * step;
  }

  /// Where the fine disk's border meets the first node of a coarse path.
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

int best_rotation(const CutDisk& cut, int size, int count, int step) {
  std::vector<int> rotations;
  for (int k = 0; k < count; ++k) rotations.push_back(2 * k * step);
  const TrialOptions options{.size = size};
  const TrialMap best = try_rotations(cut, rotations, options);
  const std::vector<int> near = {best.rotation - step, best.rotation + step};
  const TrialMap refined = try_rotations(cut, near, options);
  return refined.energy < best.energy ? refined.rotation : best.rotation;
}

}  // namespace

int choose_rotation(const CutDisk& cut, int size, int count) {
  count = std::min(count, (size - 1) / 2);
  if (count <= 1) return 0;
  const int step = (size - 1) / (2 * count);
  if (static_cast<int>(cut.disk.triangles.size()) <= max_triangles)
    return best_rotation(cut, size, count, step);
  const Surface surface = closed(cut);
  const Proxy proxy = coarsen(surface.mesh, surface.cut, max_triangles);
  const CutDisk coarse = cut_open(proxy.mesh, proxy.cut);
  const Transfer transfer{cut, coarse, proxy.source_vertex, size};
  return transfer.rotation(best_rotation(coarse, size, count, step), step);
}

}  // namespace weft
