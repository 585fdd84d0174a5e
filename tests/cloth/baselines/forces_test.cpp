
#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/baselines/spring_matrix.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/measure.h"

namespace weft {
namespace {

using namespace testing;

Planes3 elastic_forces(const Cloth& cloth, const Planes3& position) {
  Planes3 force(cloth.size);
  const SpringForces forces(cloth);
  ThreadTeam team(1);
  team.run([&](Worker& worker) {
    for (int r = 0; r < cloth.size; ++r) forces.gather_elastic(r, position, force);
    sum_over_mates(cloth.mates, worker, {&force.x, &force.y, &force.z});
  });
  return force;
}

double largest(const Planes3& planes) {
  double max = 0;
  for (int s = 0; s < planes.size() * planes.size(); ++s)
    max = std::max(max, length(vec_cast<double>(planes.at(s))));
  return max;
}

TEST(Forces, AreMinusTheGradientOfTheEnergy) {
  for (const Cloth& cloth : {sheet_cloth(7), torus_cloth(9)}) {
    ClothState state = rest_state(cloth);
    shake(cloth, 0.02, state.position);
    const Planes3 force = elastic_forces(cloth, state.position);
    const double scale = largest(force);
    const float step = 0x1p-10F;
    for (const int sample : {0, 3, cloth.size + 2, 3 * cloth.size, cloth.size * cloth.size - 2})
      for (const Vec3f displacement : {Vec3f{step, 0, 0}, Vec3f{0, step, 0}, Vec3f{0, 0, step}}) {
        ClothState ahead = state, behind = state;
        move(cloth, sample, displacement, ahead.position);
        move(cloth, sample, -displacement, behind.position);
        const double slope =
            (potential_energy(cloth, ahead, {}) - potential_energy(cloth, behind, {})) /
            (2.0 * step);
        const double along =
            dot(vec_cast<double>(force.at(sample)), vec_cast<double>(displacement)) / step;
        EXPECT_NEAR(along, -slope, 2e-3 * scale) << "sample " << sample;
      }
  }
}

TEST(Forces, RestFeelsExactlyNone) {
  const Cloth cloth = torus_cloth(33);
  EXPECT_EQ(largest(elastic_forces(cloth, cloth.rest)), 0);
}

TEST(Forces, StretchedSpringPullsTowardsTheOther) {
  const Cloth cloth = sheet_cloth(5);
  Planes3 p = cloth.rest;
  p.x(2, 4) += 0.1F;
  EXPECT_LT(elastic_forces(cloth, p).x(2, 4), 0);
}

TEST(Forces, DampingLeavesRigidMotionAlone) {
  Material material;
  material.damping = 100;
  const Cloth cloth = sheet_cloth(17, material);
  ClothState state = rest_state(cloth);
  const Vec3f turn{0.3F, 1.0F, -0.5F};
  for (int s = 0; s < 17 * 17; ++s)
    state.velocity.set(s, Vec3f{1, 2, 3} + cross(turn, state.position.at(s)));
  Planes3 force(17);
  const SpringForces forces(cloth);
  for (int r = 0; r < 17; ++r) forces.gather_damped(r, state, force);
  EXPECT_LT(largest(force), 1e-8);
}

TEST(Forces, DampingSlowsAPairAtTheGivenRate) {
  // Two rows drift apart: only springs across feel it, and momentum stays.
  Material material{.stretch = 0, .shear = 0, .bend_springs = 0, .damping = 3};
  const Cloth cloth = make_cloth(flat_sheet(2), no_mates(2), material);
  ClothState state = rest_state(cloth);
  state.velocity.x(0, 1) = 1;
  state.velocity.x(1, 1) = 1;
  Planes3 force(2);
  const SpringForces forces(cloth);
  for (int r = 0; r < 2; ++r) forces.gather_damped(r, state, force);
  const double m = cloth.mass(0, 0);
  // Half a reduced mass for the spring along the border; the diagonal takes cos^2 45 degrees of a
  // whole.
  EXPECT_NEAR(force.x(0, 1), -3 * (m / 2) * (0.5 + 0.5), 1e-6 * m);
  EXPECT_NEAR(force.x(0, 0) + force.x(1, 0) + force.x(0, 1) + force.x(1, 1), 0, 1e-7 * m);
}

TEST(SpringMatrix, IsTheDerivativeOfTheForces) {
  Material material;
  material.damping = 0;
  for (Cloth cloth : {sheet_cloth(7, material), torus_cloth(9, material)}) {
    // All springs stretched, so that no transverse part is cut off.
    Planes3 p = cloth.rest;
    for (int s = 0; s < cloth.size * cloth.size; ++s) p.set(s, 1.3F * p.at(s));
    shake(cloth, 0.003, p);
    Planes3 displacement(cloth.size), ahead = p, behind = p, image(cloth.size);
    shake(cloth, 1, displacement, 2);
    const float step = 0x1p-13F;
    for (int s = 0; s < cloth.size * cloth.size; ++s) {
      ahead.set(s, p.at(s) + step * displacement.at(s));
      behind.set(s, p.at(s) - step * displacement.at(s));
    }
    SpringMatrix matrix(cloth);
    for (int r = 0; r < cloth.size; ++r) matrix.linearise_row(p, 1, r);
    for (int r = 0; r < cloth.size; ++r) matrix.multiply_row(displacement, image, r);
    ThreadTeam team(1);
    team.run([&](Worker& worker) {
      sum_over_mates(cloth.mates, worker, {&image.x, &image.y, &image.z});
    });
    const Planes3 f1 = elastic_forces(cloth, ahead), f0 = elastic_forces(cloth, behind);
    const double scale = largest(image);
    for (int s = 0; s < cloth.size * cloth.size; ++s) {
      const Vec3f difference = (-1 / (2 * step)) * (f1.at(s) - f0.at(s));
      EXPECT_NEAR(length(difference - image.at(s)), 0, 2e-3 * scale) << "sample " << s;
    }
  }
}

TEST(SpringMatrix, CompressedSpringsKeepItPositive) {
  const Cloth cloth = sheet_cloth(9);
  Planes3 p = cloth.rest, displacement(9), image(9);
  for (int s = 0; s < 81; ++s) p.set(s, 0.5F * p.at(s));
  SpringMatrix matrix(cloth);
  for (int r = 0; r < 9; ++r) matrix.linearise_row(p, 1.0 / 240, r);
  for (int seed = 1; seed < 20; ++seed) {
    displacement = Planes3(9);
    shake(cloth, 1, displacement, seed);
    for (int r = 0; r < 9; ++r) matrix.multiply_row(displacement, image, r);
    double product = 0;
    for (int s = 0; s < 81; ++s) product += double{dot(displacement.at(s), image.at(s))};
    EXPECT_GE(product, 0);
  }
}

}  // namespace
}  // namespace weft
