#include "weft/mesh/shapes/parametric.h"

#include <cmath>
#include <vector>

#include "weft/core/math.h"
#include "weft/mesh/shapes/patch.h"

namespace weft {

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

Vec3d cylinder_point(double u, double v) {
  const double around = 2 * pi * u;
  return {cylinder_radius * cosine(around), cylinder_height * (v - 0.5),
          -cylinder_radius * sine(around)};
}

TriangleMesh sheet_mesh() { return patch_mesh({.cols = 64, .rows = 64}, sheet_point); }
TriangleMesh disk_mesh() { return patch_mesh({.cols = 64, .rows = 64}, disk_point); }
TriangleMesh torus_mesh() {
  return patch_mesh({.cols = 96, .rows = 40, .wraps_u = true, .wraps_v = true}, torus_point);
}
TriangleMesh cylinder_mesh() {
  return patch_mesh({.cols = 80, .rows = 64, .wraps_u = true}, cylinder_point);
}

namespace {

constexpr int rows = 14, cols = 228;  // around the tube, along it

/// A point on the middle line, its tangent and a direction across it.
struct Frame {
  Vec3d centre, tangent, side;
};

Vec3d tangent_at(double t) {
  constexpr double step = 1e-5;
  return normalized(knot_point(t + step) - knot_point(t - step));
}

/// Parameters at equal distances along the curve: `count` of them, the first 0.
std::vector<double> even_parameters(int count) {
  constexpr int fine = 64;  // pieces for each
  const int pieces = fine * count;
  std::vector<double> passed{0};
  for (int i = 1; i <= pieces; ++i)
    passed.push_back(passed.back() + length(knot_point(static_cast<double>(i) / pieces) -
                                            knot_point(static_cast<double>(i - 1) / pieces)));
  std::vector<double> parameters;
  for (int i = 0, k = 0; k < count; ++k) {
    const double wanted = passed.back() * k / count;
    while (passed[i + 1] <= wanted) ++i;
    parameters.push_back((i + (wanted - passed[i]) / (passed[i + 1] - passed[i])) / pieces);
  }
  return parameters;
}

Vec3d across(Vec3d direction, Vec3d tangent) {
  return normalized(direction - dot(direction, tangent) * tangent);
}

/// Rotation-minimising frames along the curve; the angle by which the last would miss the first is
/// spread over all.
std::vector<Frame> frames() {
  std::vector<Frame> list;
  Vec3d side{0, 1, 0};
  for (const double t : even_parameters(cols)) {
    const Vec3d tangent = tangent_at(t);
    side = across(side, tangent);
    list.push_back({knot_point(t), tangent, side});
  }
  const Frame& first = list.front();
  const Vec3d back = across(side, first.tangent);
  const double missed =
      arc_tangent(dot(cross(back, first.side), first.tangent), dot(back, first.side));
  for (int i = 0; i < cols; ++i) {
    const double angle = missed * i / cols;
    Frame& frame = list[i];
    frame.side = cosine(angle) * frame.side + sine(angle) * cross(frame.tangent, frame.side);
  }
  return list;
}

}  // namespace

Vec3d knot_point(double t) {
  constexpr double ring = 0.23, sway = 0.115, height = 0.11;
  const double angle = 2 * pi * t;
  const double radius = ring + sway * cosine(3 * angle);
  return {radius * cosine(2 * angle), height * sine(3 * angle), -radius * sine(2 * angle)};
}

TriangleMesh knot_mesh() {
  const std::vector<Frame> along = frames();
  return patch_mesh(
      {.cols = cols, .rows = rows, .wraps_u = true, .wraps_v = true}, [&](double u, double v) {
        const Frame& frame = along[static_cast<int>(std::lround(u * cols))];
        const double angle = 2 * pi * v;
        return frame.centre + knot_tube_radius * (cosine(angle) * frame.side +
                                                  sine(angle) * cross(frame.side, frame.tangent));
      });
}

}  // namespace weft
