#include "weft/convert/joined_normals.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "weft/convert.h"
#include "weft/geometry_image.h"
#include "weft/shapes.h"

namespace weft {
namespace {

Conversion in_charts(const TriangleMesh& mesh, int count) {
  ConvertOptions options;
  options.size = 33;
  options.charts = ChartChoice::regions;
  options.max_charts = count;
  options.normal_map_size = 65;
  options.measure = false;
  return convert_mesh(mesh, "mesh", options);
}

/// The worst cosine of the angles between normals at one point of the surface.
double worst_at_mates(const Conversion& made) {
  const int n = made.image.size(), scale = (made.normals->size() - 1) / (n - 1);
  const auto normal = [&](int sample) {
    return made.normals->normal.at(scale * (sample / n), scale * (sample % n));
  };
  double worst = 1;
  for (int k = 0; k < made.image.mates.class_count(); ++k) {
    const std::span<const int> mates = made.image.mates.copies(k);
    for (const int s : mates) worst = std::min<double>(worst, dot(normal(s), normal(mates[0])));
  }
  return worst;
}

TEST(JoinedNormals, GoOnWhereChartsMeet) {
  for (const char* name : {"sphere", "knot"})
    EXPECT_GT(worst_at_mates(in_charts(make_shape(name), 5)), 0.9999) << name;
}

/// Two squares at a right angle, parted along their edge.
TEST(JoinedNormals, StopAtSharpEdges) {
  RepairedMesh surface;
  surface.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                            {0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  surface.mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  surface.joined = {0, 1, 2, 3, 0, 3, 4, 5};
  const Piece piece{surface.mesh, {0, 1, 2, 3}, {0, 1}, 1};
  DiskMesh disk;
  disk.positions.assign(surface.mesh.positions.begin(), surface.mesh.positions.begin() + 4);
  disk.triangles = {{0, 1, 2}, {0, 2, 3}};
  disk.surface_vertex = {0, 1, 2, 3};
  for (const Vec3d normal : JoinedNormals(surface).of(disk, piece))
    EXPECT_LT(length(normal - Vec3d{0, 0, 1}), 1e-12);
}

}  // namespace
}  // namespace weft
