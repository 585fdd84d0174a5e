#include "weft/geometry_image.h"
#include "weft/image/diagonals.h"

namespace weft {
namespace {

bool has_repeated_point(const GeometryImage& image, const Triangle& t) {
  const int a = image.mates.representative(t[0]);
  const int b = image.mates.representative(t[1]);
  const int c = image.mates.representative(t[2]);
  return a == b || b == c || c == a;
}

/// A corner of a chart whose quad is folded is in no triangle: it goes with its neighbours.
void join_folded_corners(const BorderMates& mates, int chart, std::vector<int>& vertex_of) {
  const int first = mates.first_position(chart), around = mates.first_position(chart + 1) - first;
  for (int t = 0; t < around; ++t) {
    int& vertex = vertex_of[mates.sample_at(first + t)];
    if (vertex < 0) vertex = vertex_of[mates.sample_at(first + (t + 1) % around)];
  }
}

}  // namespace

std::vector<Triangle> grid_triangles(const GeometryImage& image) {
  const int n = image.size();
  const Grid<Diagonal> diagonals = choose_diagonals(image);
  std::vector<Triangle> triangles;
  triangles.reserve(2 * static_cast<std::size_t>(n - 1) * (n - 1));
  const auto add = [&](const Triangle& t) {
    if (!has_repeated_point(image, t)) triangles.push_back(t);
  };
  for (int row = 0; row < n - 1; ++row)
    for (int col = 0; col < n - 1; ++col) {
      const int a = row * n + col;
      const int b = a + 1;
      const int c = a + n + 1;
      const int d = a + n;
      switch (diagonals(row, col)) {
        case Diagonal::rising:
          add({a, b, c});
          add({a, c, d});
          break;
        case Diagonal::falling:
          add({a, b, d});
          add({b, c, d});
          break;
        case Diagonal::none:
          break;
      }
    }
  return triangles;
}

RebuiltMesh rebuild_mesh(const GeometryImage& image) {
  const int n = image.size();
  const auto count = static_cast<std::size_t>(n) * n;
  RebuiltMesh rebuilt;
  rebuilt.mesh.triangles = grid_triangles(image);
  std::vector<bool> used(count, false);
  for (Triangle& t : rebuilt.mesh.triangles)
    for (int& corner : t) used[corner = image.mates.representative(corner)] = true;

  rebuilt.vertex_of.assign(count, -1);
  for (int sample = 0; sample < n * n; ++sample) {
    if (!used[sample]) continue;
    rebuilt.vertex_of[sample] = static_cast<int>(rebuilt.sample_of.size());
    rebuilt.sample_of.push_back(sample);
    rebuilt.mesh.positions.push_back(image.world.to_world(image.cube.at(sample)));
  }
  for (Triangle& t : rebuilt.mesh.triangles)
    for (int& corner : t) corner = rebuilt.vertex_of[corner];
  for (int sample = 0; sample < n * n; ++sample)
    rebuilt.vertex_of[sample] = rebuilt.vertex_of[image.mates.representative(sample)];
  for (int k = 0; k < static_cast<int>(image.mates.charts().size()); ++k)
    join_folded_corners(image.mates, k, rebuilt.vertex_of);
  return rebuilt;
}

}  // namespace weft
