#include "tests/support/random_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/cut/voxel_mesh.h"
#include "tests/support/meshes.h"
#include "tests/support/random_points.h"
#include "weft/core/math.h"
#include "weft/mesh/shapes/field.h"
#include "weft/mesh/surface_parts.h"
#include "weft/mesh/topology.h"

namespace weft::test {
namespace {

TriangleMesh largest_part(TriangleMesh mesh) {
  const EdgeUses edges = edge_uses(static_cast<int>(mesh.positions.size()), mesh.triangles);
  const SurfaceParts parts = surface_parts(mesh, edges);
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (parts.part_of[t] == 0) kept.push_back(mesh.triangles[t]);
  mesh.triangles = std::move(kept);
  return mesh;
}

}  // namespace

TriangleMesh patch(int rows, int cols) {
  TriangleMesh mesh;
  for (int row = 0; row <= rows; ++row)
    for (int col = 0; col <= cols; ++col) mesh.positions.push_back({1.0 * col, 0, -1.0 * row});
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col) {
      const int a = row * (cols + 1) + col;
      mesh.triangles.push_back({a, a + 1, a + cols + 2});
      mesh.triangles.push_back({a, a + cols + 2, a + cols + 1});
    }
  return mesh;
}

TriangleMesh slab(Random& random, double triangles) {
  const int side = std::clamp(static_cast<int>(std::sqrt(triangles / 24)), 1, 3);
  std::vector<std::string> rows(2 * side + 1, std::string(2 * side + 1, '#'));
  for (int y = 0; y < 2 * side + 1; ++y)
    for (int x = 0; x < 2 * side + 1; ++x) {
      if (y % 2 == 1 && x % 2 == 1 && chance(random, 0.6)) rows[y][x] = '.';
      if (y % 2 == 0 && x % 2 == 0 && chance(random, 0.2)) rows[y][x] = 'o';
    }
  return slab_surface({rows.begin(), rows.end()});
}

TriangleMesh waves(Random& random, double triangles) {
  std::array<Vec3d, 4> wave;
  std::array<double, 4> phase{};
  for (int k = 0; k < 4; ++k) {
    wave[k] = random_point(random, 4);
    phase[k] = random.uniform(0, 2 * pi);
  }
  const auto field = [&](Vec3d p) {
    double sum = 0;
    for (int k = 0; k < 4; ++k) sum += sine(dot(wave[k], p) + phase[k]);
    return std::max(sum, 3 * (length(p) - 1));
  };
  Box3d box;
  box.add({-1.4, -1.4, -1.4});
  box.add({1.4, 1.4, 1.4});
  const TriangleMesh all = polygonise(field, box, std::sqrt(60 / triangles));
  return all.triangles.empty() ? tetrahedron() : largest_part(all);
}

}  // namespace weft::test
