#include "weft/param/triangle_energy.h"

#include <gtest/gtest.h>

#include "weft/core/random.h"

namespace weft::triangle_energy_test {
namespace {

struct Case {
  SurfaceTriangle surface;
  std::array<double, 6> corners{};
};

Case random_case(Random& random) {
  const auto point = [&] {
    return Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  };
  const std::vector<Vec3d> positions = {point(), point(), point()};
  Case result{surface_triangles(positions, std::vector<Triangle>{{0, 1, 2}})[0], {}};
  result.corners = {0,
                    0,
                    random.uniform(1, 2),
                    random.uniform(-0.5, 0.5),
                    random.uniform(-1, 1),
                    random.uniform(1, 2)};
  return result;
}

TriangleEnergy energy_at(const SurfaceTriangle& surface, const std::array<double, 6>& x) {
  return triangle_energy(surface, {x[0], x[1]}, {x[2], x[3]}, {x[4], x[5]});
}

std::array<double, 6> moved(std::array<double, 6> x, const std::array<double, 6>& by,
                            double scale) {
  for (int i = 0; i < 6; ++i) x[i] += scale * by[i];
  return x;
}

TEST(TriangleEnergy, IsAreaTimesMeanSquareStretch) {
  Random random(1);
  for (int k = 0; k < 20; ++k) {
    const Case c = random_case(random);
    const auto& x = c.corners;
    const TriangleStretch stretch =
        triangle_stretch(c.surface, {x[0], x[1]}, {x[2], x[3]}, {x[4], x[5]});
    const double expected = c.surface.area * stretch.mean_square;
    EXPECT_NEAR(energy_at(c.surface, x).value, expected, 1e-12 * expected);
  }
}

TEST(TriangleEnergy, GradientMatchesFiniteDifferences) {
  Random random(2);
  for (int k = 0; k < 20; ++k) {
    const Case c = random_case(random);
    const TriangleEnergy energy = energy_at(c.surface, c.corners);
    for (int i = 0; i < 6; ++i) {
      std::array<double, 6> axis{};
      axis[i] = 1;
      const double h = 1e-6;
      const double difference = (energy_at(c.surface, moved(c.corners, axis, h)).value -
                                 energy_at(c.surface, moved(c.corners, axis, -h)).value) /
                                (2 * h);
      EXPECT_NEAR(energy.gradient[i], difference, 1e-7 * (1 + energy.value));
    }
  }
}

TEST(TriangleEnergy, HessianIsTheTrueOneWithNothingButNegativeCurvatureRemoved) {
  Random random(3);
  int equal = 0;
  for (int k = 0; k < 200; ++k) {
    const Case c = random_case(random);
    const TriangleEnergy energy = energy_at(c.surface, c.corners);
    std::array<double, 6> d{};
    for (double& x : d) x = random.uniform(-1, 1);
    double projected = 0;
    for (const auto& square : energy.squares) {
      double product = 0;
      for (int i = 0; i < 6; ++i) product += square[i] * d[i];
      projected += product * product;
    }
    const double h = 1e-4;
    const double exact = (energy_at(c.surface, moved(c.corners, d, h)).value - 2 * energy.value +
                          energy_at(c.surface, moved(c.corners, d, -h)).value) /
                         (h * h);
    const double tolerance = 1e-4 * (1 + energy.value + projected);
    EXPECT_GE(projected, exact - tolerance);
    if (projected < exact + tolerance + 0.05 * projected) ++equal;
  }
  EXPECT_GT(equal, 20);
}

TEST(TriangleEnergy, EmphasisedGradientAndCurvatureMatchFiniteDifferences) {
  Random random(4);
  const double quartic = 0.7;
  for (int k = 0; k < 20; ++k) {
    const Case c = random_case(random);
    const auto weighed_by_curvature = [&](const std::array<double, 6>& x) {
      TriangleEnergy energy = energy_at(c.surface, x);
      weigh_by_curvature(energy, c.surface.area, quartic);
      return energy;
    };
    const TriangleEnergy energy = weighed_by_curvature(c.corners);
    const double m = energy_at(c.surface, c.corners).value / c.surface.area;
    EXPECT_NEAR(energy.value, c.surface.area * (m + quartic * m * m / 2), 1e-12 * energy.value);
    for (int i = 0; i < 6; ++i) {
      std::array<double, 6> axis{};
      axis[i] = 1;
      const double h = 1e-5;
      const double above = weighed_by_curvature(moved(c.corners, axis, h)).value;
      const double below = weighed_by_curvature(moved(c.corners, axis, -h)).value;
      EXPECT_NEAR(energy.gradient[i], (above - below) / (2 * h), 1e-5 * (1 + energy.value));
      double projected = 0;
      for (const auto& square : energy.squares) projected += square[i] * square[i];
      const double exact = (above - 2 * energy.value + below) / (h * h);
      EXPECT_GE(projected, exact - 1e-3 * (1 + energy.value + projected));
    }
  }
}

TEST(TriangleEnergy, InverseStretchIsExactlyItsSquares) {
  Random random(6);
  for (int k = 0; k < 20; ++k) {
    const Case c = random_case(random);
    const double weight = 0.3 / c.surface.area;
    const auto inverse = [&](const std::array<double, 6>& x) {
      TriangleEnergy energy;
      add_inverse_stretch(energy, c.surface, weight,
                          {Vec2d{x[0], x[1]}, Vec2d{x[2], x[3]}, Vec2d{x[4], x[5]}});
      return energy;
    };
    const auto& x = c.corners;
    const TriangleEnergy here = inverse(x);
    const Vec2d p{x[2] - x[0], x[3] - x[1]};
    const Vec2d q{x[4] - x[0], x[5] - x[1]};
    const double expected = weight * (c.surface.g11 * dot(q, q) - 2 * c.surface.g12 * dot(p, q) +
                                      c.surface.g22 * dot(p, p));
    EXPECT_NEAR(here.value, expected, 1e-12 * expected);
    std::array<double, 6> step{};
    for (double& d : step) d = random.uniform(-1, 1);
    double change = 0;
    for (int i = 0; i < 6; ++i) change += here.gradient[i] * step[i];
    for (const auto& square : here.squares) {
      double product = 0;
      for (int i = 0; i < 6; ++i) product += square[i] * step[i];
      change += 0.5 * product * product;
    }
    // Quadratic: the second-order model is exact however far the step goes.
    const double reached = inverse(moved(x, step, 1)).value;
    EXPECT_NEAR(here.value + change, reached, 1e-11 * (expected + reached));
  }
}

TEST(TriangleEnergy, OfAnIsometryGrowsByThreeTimesTheSquareOfAStrain) {
  // J = I: a strain e along u changes area * (1 / (1 + e)^2 + 1) / 2 by -area e + 3/2 area e^2.
  const SurfaceTriangle surface{1, 0, 1, 0.5};
  const TriangleEnergy energy = triangle_energy(surface, {0, 0}, {1, 0}, {0, 1});
  double second = 0;
  for (const auto& square : energy.squares) second += square[2] * square[2];
  EXPECT_NEAR(energy.gradient[2], -0.5, 1e-15);
  EXPECT_NEAR(second, 3 * 0.5, 1e-14);
}

}  // namespace
}  // namespace weft::triangle_energy_test
