// Bending of cloth whose warp and weft differ.
#include <gtest/gtest.h>

#include "tests/cloth/bent_sheets.h"

namespace weft {
namespace {

using namespace testing;

/// Rows along x, columns 30 degrees off z.
Planes3 skew_sheet(int n) {
  return mapped(flat_sheet(n), [](Vec3d p) { return Vec3d{p.x + 0.5 * p.z, 0, p.z}; });
}

/// Rows along (cos, sin) of an angle of 30 degrees in the plane of x and z.
constexpr double row_x = 0.86602540378443865, row_z = 0.5;
Planes3 turned_sheet(int n) {
  return mapped(flat_sheet(n), [](Vec3d p) {
    return Vec3d{row_x * p.x - row_z * p.z, 0, row_z * p.x + row_x * p.z};
  });
}

/// The stiffness B of a cloth rolled onto a cylinder of radius 1/2 that bends x, or z, from its
/// energy B/2 4 on all of its area.
double rolled_stiffness(const Cloth& cloth, bool bends_x) {
  const auto roll = [&](Vec3d p) {
    const double along = bends_x ? p.x : p.z, rest = bends_x ? p.z : p.x;
    return Vec3d{0.5 * sine(2 * along), -0.5 * cosine(2 * along), rest};
  };
  const double area = total_mass(cloth) / cloth.material.density;
  return bending_energy(cloth, mapped(cloth.rest, roll)) / (0.5 * 4 * area);
}

TEST(Bending, CylindersBendTheirWarpOrTheirWeft) {
  const int n = 33;
  const double inner = 1 - 1.0 / (n - 1);  // half a row at either end is not bent
  const Cloth cloth = flat_cloth(flat_sheet(n), stiff_warp);
  EXPECT_NEAR(rolled_stiffness(cloth, true) / (stiff_warp.bending.warp * inner), 1, 1e-3);
  EXPECT_NEAR(rolled_stiffness(cloth, false) / (stiff_warp.bending.weft * inner), 1, 1e-3);
}

TEST(Bending, WarpFollowsTheRowsAndWeftIsAtRightAnglesToThem) {
  const Cloth skew = flat_cloth(skew_sheet(65), stiff_warp);
  EXPECT_NEAR(rolled_stiffness(skew, true) / stiff_warp.bending.warp, 1, 0.05);
  EXPECT_NEAR(rolled_stiffness(skew, false) / stiff_warp.bending.weft, 1, 0.05);
}

TEST(Bending, BiasIsBetweenWarpAndWeft) {
  // sqrt(B) in a direction: that of the warp times its cosine squared, and of the weft by the sine.
  const Cloth cloth = flat_cloth(turned_sheet(65), stiff_warp);
  const double warp = std::sqrt(stiff_warp.bending.warp), weft = std::sqrt(stiff_warp.bending.weft);
  const double along_x = warp * 0.75 + weft * 0.25, along_z = warp * 0.25 + weft * 0.75;
  EXPECT_NEAR(rolled_stiffness(cloth, true) / (along_x * along_x), 1, 0.05);
  EXPECT_NEAR(rolled_stiffness(cloth, false) / (along_z * along_z), 1, 0.05);
}

TEST(Bending, WovenBowlHasTheEnergyOfBothCurvatures) {
  // y = x^2 / 2 + x z / 3 + z^2: second derivatives 1 and 2, the Gaussian curvature 2 - 1/9.
  const auto bowl = [](Vec3d p) {
    return Vec3d{p.x, 0.5 * p.x * p.x + p.x * p.z / 3 + p.z * p.z, p.z};
  };
  const double warp = std::sqrt(stiff_warp.bending.warp), weft = std::sqrt(stiff_warp.bending.weft);
  const double sum = warp + 2 * weft;
  const double density = 0.5 * sum * sum - 0.75 * warp * weft * (2 - 1.0 / 9);
  for (const Planes3& rest : {flat_sheet(65), skew_sheet(65)}) {
    const Cloth cloth = flat_cloth(rest, stiff_warp);
    const double area = total_mass(cloth) / cloth.material.density;
    EXPECT_NEAR(bending_energy(cloth, mapped(rest, bowl)) / (density * area), 1, 0.05);
  }
}

TEST(Bending, ExchangedThreadsAreATransposedCloth) {
  const int n = 17;
  const Planes3 rest = uneven_sheet(n);
  Planes3 transposed(n), p(n), q(n);
  const Cloth one = flat_cloth(flat_sheet(n), stiff_warp);
  for (int s = 0; s < n * n; ++s) transposed.set(s % n * n + s / n, one.rest.at(s));
  const Cloth other = flat_cloth(transposed, {.bending = {1e-3 / 9, 1e-3}});
  p = rest;
  shake(one, 0.01, p);
  for (int s = 0; s < n * n; ++s) q.set(s % n * n + s / n, p.at(s));
  const double energy = bending_energy(one, p);
  EXPECT_NEAR(bending_energy(other, q), energy, 1e-5 * energy);
}

TEST(Bending, SaddleHasTheEnergyOfItsTwist) {
  // z = c x y bends nowhere on average; three quarters of its twist count: (1 - nu) B c^2 area.
  const auto saddle = [](Vec3d p) { return Vec3d{p.x, 0.8 * p.x * p.z, p.z}; };
  const auto relative_energy = [&](const Planes3& rest) {
    const Cloth cloth = flat_cloth(rest);
    const double area = total_mass(cloth) / cloth.material.density;
    return bending_energy(cloth, mapped(rest, saddle)) / (0.75 * stiff.bending.warp * 0.64 * area);
  };
  EXPECT_NEAR(relative_energy(flat_sheet(9)), 1, 1e-4);
  EXPECT_NEAR(relative_energy(uneven_sheet(33)), 1, 0.05);
  EXPECT_NEAR(relative_energy(disk(33)), 1, 0.05);
}

}  // namespace
}  // namespace weft
