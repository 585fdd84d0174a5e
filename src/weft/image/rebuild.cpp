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
      if (diagonals(row, col) == Diagonal::rising) {
        add({a, b, c});
        add({a, c, d});
      } else {
        add({a, b, d});
        add({b, c, d});
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
  for (int sample = 0; sample < n * n; ++sample) {
    const int point = image.mates.representative(sample);
    if (used[point]) {
      rebuilt.vertex_of[sample] = rebuilt.vertex_of[point];
    } else {  // a corner of the square whose quad is folded
      const int next = border_sample(n, (border_position(n, sample) + 1) % (4 * (n - 1)));
      rebuilt.vertex_of[sample] = rebuilt.vertex_of[image.mates.representative(next)];
    }
  }
  return rebuilt;
}

}  // namespace weft
