#include "weft/cloth/cloth.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "tests/support/errors.h"
#include "weft/cloth/measure.h"
#include "weft/error.h"

namespace weft {
namespace {

using namespace testing;

std::string refusal(const Planes3& rest, const Material& material) {
  return test::message_of<SceneError>([&] { make_cloth(rest, no_mates(rest.size()), material); });
}

TEST(Cloth, UniformGridHasTheStiffnessOfTheFabric) {
  const Material material{.bend_springs = 0.5};
  for (const int n : {9, 33}) {
    const Cloth cloth = sheet_cloth(n, material);
    const int middle = n / 2;
    EXPECT_NEAR(cloth.springs[stretch_u].stiffness(middle, middle), material.stretch.warp, 1);
    EXPECT_NEAR(cloth.springs[stretch_v].stiffness(middle, middle), material.stretch.warp, 1);
    EXPECT_NEAR(cloth.springs[stretch_u].stiffness(0, middle), material.stretch.warp / 2, 1);
    EXPECT_NEAR(cloth.springs[stretch_v].stiffness(middle, n - 1), material.stretch.warp / 2, 1);
    EXPECT_NEAR(cloth.springs[shear_1].stiffness(0, 0), material.shear / 2, 1);
    EXPECT_NEAR(cloth.springs[shear_2].stiffness(0, 1), material.shear / 2, 1);
    EXPECT_FLOAT_EQ(cloth.springs[bend_u].stiffness(middle, 0), 0.5F);
    EXPECT_EQ(cloth.springs[stretch_u].stiffness(0, n - 1), 0);
    EXPECT_EQ(cloth.springs[shear_2].stiffness(0, 0), 0);
    EXPECT_NEAR(cloth.rest_spacing, 1.0 / (n - 1), 1e-6);
  }
}

TEST(Cloth, MassIsDensityTimesArea) {
  const Cloth cloth = sheet_cloth(17);
  const double whole = 0.2 / (16 * 16);
  EXPECT_NEAR(total_mass(cloth), 0.2, 1e-6);
  EXPECT_NEAR(cloth.mass(8, 8), whole, 1e-9);
  EXPECT_NEAR(cloth.mass(0, 8), whole / 2, 1e-9);
  EXPECT_NEAR(cloth.mass(16, 0), whole / 4, 1e-9);
  EXPECT_EQ(cloth.particles, 17 * 17);
}

TEST(Cloth, MatesAreOneParticle) {
  const int n = 33;
  const Cloth cloth = torus_cloth(n);
  EXPECT_EQ(cloth.particles, (n - 1) * (n - 1));
  const double area = 4 * pi * pi * 0.4 * 0.15;
  EXPECT_NEAR(total_mass(cloth), 0.2 * area, 0.01 * 0.2 * area);
  // The torus looks the same all around its axis, so the seam weighs what any other column does.
  for (int r = 0; r < n; ++r) {
    EXPECT_NEAR(cloth.mass(r, 0) / cloth.mass(r, 5), 1, 1e-4);
    EXPECT_EQ(cloth.mass(r, 0), cloth.mass(r, n - 1));
  }
}

TEST(Cloth, SeamSpringIsHalfOnEachSide) {
  const int n = 17;
  const Cloth cloth = torus_cloth(n);
  const Grid<float>& k = cloth.springs[stretch_v].stiffness;
  for (int r = 0; r + 1 < n; ++r)
    EXPECT_NEAR((k(r, 0) + k(r, n - 1)) / k(r, 5), 1, 1e-4) << "row " << r;
}

TEST(Cloth, SpringBetweenMatesIsDropped) {
  // Border positions 3 and 5 are mates around the corner at 4, so the diagonal beside it joins
  // mates.
  const int n = 5;
  Planes3 rest = flat_sheet(n);
  rest.set(1, 4, rest.at(0, 3));
  const Cloth cloth = make_cloth(rest, BorderMates(n, {{3, 5, 1}}), {});
  EXPECT_EQ(cloth.springs[shear_1].stiffness(0, 3), 0);
  EXPECT_EQ(cloth.springs[shear_1].damping(0, 3), 0);
  EXPECT_GT(cloth.springs[shear_1].stiffness(0, 2), 0);
  for (const BorderSpring& spring : cloth.border_springs) EXPECT_LT(spring.from, spring.to);
}

TEST(Cloth, BorderSpringsHoldEachParticlePairOnce) {
  const int n = 9;
  const Cloth cloth = torus_cloth(n);
  // Every stretch and shear spring of the closed surface, less those between interior samples.
  const int all = 4 * (n - 1) * (n - 1);
  const int inside = 2 * (n - 2) * (n - 3) + 2 * (n - 3) * (n - 3);
  EXPECT_EQ(static_cast<int>(cloth.border_springs.size()), all - inside);
}

TEST(Cloth, TinyCellsKeepTheirFloors) {
  const int n = 9;
  Planes3 rest = flat_sheet(n);
  for (int r = 0; r < n; ++r) rest.set(r, 1, rest.at(r, 0));
  const Cloth cloth = make_cloth(rest, no_mates(n), {});
  for (int r = 0; r < n; ++r) {
    EXPECT_GT(cloth.springs[stretch_u].rest_length(r, 0), 0.9e-3 * cloth.rest_spacing);
    EXPECT_GT(cloth.mass(r, 0), 0);
    EXPECT_TRUE(std::isfinite(cloth.inverse_mass(r, 0)));
  }
}

TEST(Cloth, ShapeWithoutAreaIsRefused) {
  EXPECT_NE(refusal(Planes3(9), {}).find("carry no mass"), std::string::npos);
}

TEST(Cloth, PositionThatIsNotFiniteIsNamed) {
  Planes3 rest = flat_sheet(9);
  rest.x(3, 4) = NAN;
  EXPECT_NE(refusal(rest, {}).find("row 3, col 4"), std::string::npos);
}

TEST(Cloth, MaterialOutOfRangeNamesItsKey) {
  EXPECT_NE(refusal(flat_sheet(5), {.density = 0}).find("material.density"), std::string::npos);
  EXPECT_NE(refusal(flat_sheet(5), {.stretch = -1}).find("material.stretch"), std::string::npos);
  EXPECT_NE(refusal(flat_sheet(5), {.strain_limit = 1}).find("material.strain_limit"),
            std::string::npos);
}

TEST(Cloth, PinHoldsTheWholeClass) {
  const int n = 9;
  Cloth cloth = torus_cloth(n);
  pin(cloth, n * n - 1, {1, 2, 3});
  ASSERT_EQ(cloth.pins.size(), 1U);
  // The sample that was asked for: while a garment is sewn, its mates are elsewhere.
  EXPECT_EQ(cloth.pins[0].sample, n * n - 1);
  EXPECT_EQ(cloth.pins[0].copies, (std::vector<int>{0, n - 1, n * (n - 1), n * n - 1}));
  for (const int s : cloth.pins[0].copies) EXPECT_EQ(cloth.inverse_mass(s / n, s % n), 0);
  pin(cloth, 0, {4, 5, 6});
  ASSERT_EQ(cloth.pins.size(), 1U);
  EXPECT_EQ(cloth.pins[0].target, (Vec3d{4, 5, 6}));
  EXPECT_THROW(pin(cloth, n * n, {}), SceneError);
}

TEST(Measure, StrainOfAUniformStretch) {
  const Cloth cloth = sheet_cloth(17);
  ClothState state = rest_state(cloth);
  for (int s = 0; s < 17 * 17; ++s) {
    const Vec3f p = state.position.at(s);
    state.position.set(s, {1.1F * p.x, p.y, p.z});
  }
  const StrainSummary strain = measure_strain(cloth, state);
  EXPECT_NEAR(strain.mean, 0.05, 1e-5);
  EXPECT_NEAR(strain.p99, 0.1, 1e-5);
  EXPECT_NEAR(strain.max, 0.1, 1e-5);
}

TEST(Measure, EnergiesAndCentreOfAMovingSheet) {
  const Cloth cloth = sheet_cloth(9);
  ClothState state = rest_state(cloth, {3, 0, 4});
  state.position.y.fill(2);
  EXPECT_NEAR(kinetic_energy(cloth, state), 0.5 * 0.2 * 25, 1e-5);
  EXPECT_NEAR(potential_energy(cloth, state, {0, -9.81, 0}), 0.2 * 9.81 * 2, 1e-5);
  EXPECT_NEAR(centre_of_mass(cloth, state).y, 2, 1e-6);
  EXPECT_FALSE(find_not_finite(state).has_value());
  state.velocity.z(5, 6) = INFINITY;
  ASSERT_TRUE(find_not_finite(state).has_value());
  EXPECT_EQ(find_not_finite(state)->row, 5);
  EXPECT_EQ(find_not_finite(state)->col, 6);
}

}  // namespace
}  // namespace weft
