#include "weft/mesh/shapes/parametric.h"

#include <cmath>

#include "weft/core/math.h"

namespace weft {
namespace {

/// A cols x rows patch of quads over the unit square. Where it wraps, the last column (row) of
/// vertices is the first.
struct Patch {
  int cols = 0, rows = 0;
  bool wraps = false;
  [[nodiscard]] int vertex_cols() const { return wraps ? cols : cols + 1; }
  [[nodiscard]] int vertex_rows() const { return wraps ? rows : rows + 1; }
  [[nodiscard]] int vertex(int row, int col) const {
    return (row % vertex_rows()) * vertex_cols() + col % vertex_cols();
  }
};

/// Splits a quad along its shorter diagonal, counter-clockwise in the (u, v) plane.
void add_quad(TriangleMesh& mesh, const std::array<int, 4>& q) {
  const auto squared = [&](int i, int j) {
    return squared_length(mesh.positions[i] - mesh.positions[j]);
  };
  if (squared(q[0], q[2]) <= squared(q[1], q[3])) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  } else {
    mesh.triangles.push_back({q[0], q[1], q[3]});
    mesh.triangles.push_back({q[1], q[2], q[3]});
  }
}

TriangleMesh patch_mesh(const Patch& patch, Vec3d (*point)(double, double)) {
  TriangleMesh mesh;
  for (int r = 0; r < patch.vertex_rows(); ++r)
    for (int c = 0; c < patch.vertex_cols(); ++c)
      mesh.positions.push_back(
          point(static_cast<double>(c) / patch.cols, static_cast<double>(r) / patch.rows));
  for (int r = 0; r < patch.rows; ++r)
    for (int c = 0; c < patch.cols; ++c)
      add_quad(mesh, {patch.vertex(r, c), patch.vertex(r, c + 1), patch.vertex(r + 1, c + 1),
                      patch.vertex(r + 1, c)});
  return mesh;
}

}  // namespace

Vec3d sheet_point(double u, double v) { return {u - 0.5, 0, v - 0.5}; }

Vec3d disk_point(double u, double v) {
  const double x = 2 * u - 1, z = 2 * v - 1;
  if (x == 0 && z == 0) return {};
  // The ring is fixed by the larger coordinate, the angle on it by the ratio of the two.
  const bool along_x = std::abs(x) > std::abs(z);
  const double ring = 0.5 * (along_x ? x : z);
  const double angle = 0.25 * pi * (along_x ? z / x : x / z);
  const double near = ring * cosine(angle), far = ring * sine(angle);
  return along_x ? Vec3d{near, 0, far} : Vec3d{far, 0, near};
}

Vec3d torus_point(double u, double v) {
  const double around = 2 * pi * u, tube = 2 * pi * v;
  const double radius = torus_major_radius + torus_minor_radius * cosine(tube);
  return {radius * cosine(around), torus_minor_radius * sine(tube), -radius * sine(around)};
}

TriangleMesh sheet_mesh() { return patch_mesh({.cols = 64, .rows = 64}, sheet_point); }
TriangleMesh disk_mesh() { return patch_mesh({.cols = 64, .rows = 64}, disk_point); }
TriangleMesh torus_mesh() {
  return patch_mesh({.cols = 96, .rows = 40, .wraps = true}, torus_point);
}

}  // namespace weft
