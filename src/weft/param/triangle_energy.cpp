#include "weft/param/triangle_energy.h"

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

/// A symmetric 2 x 2 matrix by its eigenvalues and the unit eigenvector of the larger.
struct Eigen2 {
  double larger = 0, smaller = 0;
  Vec2d axis{1, 0};
};

Eigen2 eigen_decompose(double xx, double xy, double yy) {
  const double mean = 0.5 * (xx + yy);
  const double half = 0.5 * (xx - yy);
  const double radius = std::sqrt(half * half + xy * xy);
  if (radius <= 1e-15 * mean) return {mean, mean, {1, 0}};
  // The one of two equivalent formulas that has no cancellation.
  const Vec2d axis = half >= 0 ? Vec2d{half + radius, xy} : Vec2d{xy, radius - half};
  return {mean + radius, std::max(0.0, mean - radius), normalized(axis)};
}

}  // namespace

TriangleEnergy triangle_energy(const SurfaceTriangle& surface, Vec2d a, Vec2d b, Vec2d c) {
  const Vec2d p = b - a;
  const Vec2d q = c - a;
  const double d = cross(p, q);
  // Gradients of the three linear hat functions in the plane.
  const Vec2d hat1 = {q.y / d, -q.x / d};
  const Vec2d hat2 = {-p.y / d, p.x / d};
  const std::array<Vec2d, 3> hat = {Vec2d{} - hat1 - hat2, hat1, hat2};

  const auto metric = [&](double s1, double s2, double t1, double t2) {
    return surface.g11 * s1 * t1 + surface.g12 * (s1 * t2 + s2 * t1) + surface.g22 * s2 * t2;
  };
  const double gxx = metric(hat1.x, hat2.x, hat1.x, hat2.x);
  const double gxy = metric(hat1.x, hat2.x, hat1.y, hat2.y);
  const double gyy = metric(hat1.y, hat2.y, hat1.y, hat2.y);

  TriangleEnergy energy;
  energy.value = 0.5 * surface.area * (gxx + gyy);
  const auto [g1, g2, axis] = eigen_decompose(gxx, gxy, gyy);
  const double trace = g1 + g2;
  const double half = 0.5 * (g1 - g2);
  const double mixed = 0.5 * trace + std::sqrt(half * half + trace * trace);
  const Vec2d part = normalized(Vec2d{trace, mixed - g1});
  const double scale1 = std::sqrt(3 * g1 * surface.area);
  const double scale2 = std::sqrt(3 * g2 * surface.area);
  const double scale3 = std::sqrt(mixed * surface.area);
  for (int k = 0; k < 3; ++k) {
    energy.gradient[2 * k] = -surface.area * (gxx * hat[k].x + gxy * hat[k].y);
    energy.gradient[2 * k + 1] = -surface.area * (gxy * hat[k].x + gyy * hat[k].y);
    // Components of the hat gradient in the eigenbasis; the factors of `axis` below rotate the
    // displacement of the corner into it.
    const double along = dot(axis, hat[k]);
    const double across = cross(axis, hat[k]);
    const double x12 = scale3 * part.x * across;
    const double x21 = scale3 * part.y * along;
    energy.squares[0][2 * k] = scale1 * along * axis.x;
    energy.squares[0][2 * k + 1] = scale1 * along * axis.y;
    energy.squares[1][2 * k] = -scale2 * across * axis.y;
    energy.squares[1][2 * k + 1] = scale2 * across * axis.x;
    energy.squares[2][2 * k] = x12 * axis.x - x21 * axis.y;
    energy.squares[2][2 * k + 1] = x12 * axis.y + x21 * axis.x;
  }
  return energy;
}

void weigh_by_curvature(TriangleEnergy& energy, double area, double quartic) {
  if (!(quartic > 0) || !(area > 0)) return;
  const double mean_square = energy.value / area;
  const double factor = 1 + quartic * mean_square;
  const double root = std::sqrt(factor);
  const double outer = std::sqrt(quartic / area);
  for (int k = 0; k < 6; ++k) {
    for (int s = 0; s < 3; ++s) energy.squares[s][k] *= root;
    energy.squares[3][k] = outer * energy.gradient[k];
    energy.gradient[k] *= factor;
  }
  energy.value = area * mean_square * (1 + 0.5 * quartic * mean_square);
}

void add_inverse_stretch(TriangleEnergy& energy, const SurfaceTriangle& surface, double weight,
                         const std::array<Vec2d, 3>& corners) {
  if (!(weight > 0) || !(surface.g22 > 0)) return;
  const double share = surface.g12 / surface.g22;
  const double rest = std::max(0.0, surface.g11 - surface.g12 * share);
  // n = g22 |p - share q|^2 + rest |q|^2, separately in each coordinate.
  const std::array<double, 3> first = {share - 1, 1, -share};
  const std::array<double, 3> second = {-1, 0, 1};
  const auto add = [&](int row, const std::array<double, 3>& form, double factor) {
    const double root = std::sqrt(2 * weight * factor);
    Vec2d sum{};
    for (int k = 0; k < 3; ++k) sum = sum + form[k] * corners[k];
    energy.value += weight * factor * dot(sum, sum);
    for (int k = 0; k < 3; ++k) {
      energy.gradient[2 * k] += 2 * weight * factor * form[k] * sum.x;
      energy.gradient[2 * k + 1] += 2 * weight * factor * form[k] * sum.y;
      energy.squares[row][2 * k] = root * form[k];
      energy.squares[row + 1][2 * k + 1] = root * form[k];
    }
  };
  add(4, first, surface.g22);
  add(6, second, rest);
}

double inverse_weight(const SurfaceTriangle& surface) {
  constexpr double share = 0.2;
  constexpr double flattest = 0.01;  // area over the sum of the squared sides
  const auto& [g11, g12, g22, area] = surface;
  const double min = flattest * 2 * (g11 - g12 + g22);
  const double raised = std::sqrt(area * area + min * min);
  return raised > 0 ? share / (8 * raised) : 0;
}

}  // namespace weft
