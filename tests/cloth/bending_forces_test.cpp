// Forces of bending against its energy, its bound and its diagonal.
#include <gtest/gtest.h>

#include "tests/cloth/bent_sheets.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

using namespace testing;

TEST(Bending, ForcesAreMinusTheGradient) {
  for (const Cloth& cloth : {flat_cloth(uneven_sheet(9)), torus_cloth(9, stiff),
                             flat_cloth(uneven_sheet(9), stiff_warp), torus_cloth(9, stiff_warp)}) {
    Planes3 p = cloth.rest;
    shake(cloth, 0.03, p);
    const Planes3 force = forces(cloth, p);
    const float step = 0x1p-10F;
    for (const int sample : {0, 4, 9, 10, 40, 44, 71, 79})
      for (const Vec3f displacement : {Vec3f{step, 0, 0}, Vec3f{0, step, 0}, Vec3f{0, 0, step}}) {
        Planes3 ahead = p, behind = p;
        move(cloth, sample, displacement, ahead);
        move(cloth, sample, -displacement, behind);
        const double slope =
            (bending_energy(cloth, ahead) - bending_energy(cloth, behind)) / (2.0 * step);
        const double along =
            dot(vec_cast<double>(force.at(sample)), vec_cast<double>(displacement)) / step;
        EXPECT_NEAR(along, -slope, 1e-3 * largest(force)) << "sample " << sample;
      }
  }
}

TEST(Bending, TurnedTorusFeelsNone) {
  for (const Material& material : {stiff, stiff_warp}) {
    const Cloth cloth = torus_cloth(33, material);
    EXPECT_TRUE(cloth.bending.curved);
    EXPECT_LT(largest(forces(cloth, cloth.rest)), force_of_a_hair(cloth));
    const double left = largest(forces(cloth, mapped(cloth.rest, turned)));
    EXPECT_LT(left, force_of_a_hair(cloth));
    const auto wider = [](Vec3d p) { return 1.1 * p; };
    EXPECT_GT(largest(forces(cloth, mapped(cloth.rest, wider))), 10 * left);
  }
}

TEST(Bending, TurnedFlatClothStaysFlat) {
  const Planes3 rest = mapped(flat_sheet(65), turned);
  EXPECT_FALSE(flat_cloth(rest).bending.curved);
}

TEST(Bending, ForcesOfOneClothAddUpToNone) {
  for (const Cloth& cloth :
       {flat_cloth(uneven_sheet(17)), torus_cloth(17, stiff), torus_cloth(17, stiff_warp)}) {
    Planes3 p = cloth.rest;
    shake(cloth, 0.01, p);
    const Planes3 force = forces(cloth, p);
    Vec3d sum;
    for (int s = 0; s < cloth.size * cloth.size; ++s)
      sum += double{cloth.owner(s / cloth.size, s % cloth.size)} * vec_cast<double>(force.at(s));
    EXPECT_LT(length(sum), 1e-4 * largest(force));
  }
}

TEST(Bending, ForcesTurnNothing) {
  for (const Cloth& cloth :
       {flat_cloth(uneven_sheet(17)), torus_cloth(17, stiff), torus_cloth(17, stiff_warp)}) {
    Planes3 p = cloth.rest;
    shake(cloth, 0.01, p);
    const Planes3 force = forces(cloth, p);
    Vec3d torque;
    for (int s = 0; s < 17 * 17; ++s)
      torque += double{cloth.owner(s / 17, s % 17)} *
                cross(vec_cast<double>(p.at(s)), vec_cast<double>(force.at(s)));
    EXPECT_LT(length(torque), 1e-4 * largest(force));
  }
}

TEST(Bending, ChangeIsTheDerivativeAtRest) {
  for (const Cloth& cloth :
       {flat_cloth(uneven_sheet(17)), torus_cloth(17, stiff), torus_cloth(17, stiff_warp)}) {
    Planes3 displacement(17), ahead = cloth.rest, behind = cloth.rest;
    shake(cloth, 1, displacement, 2);
    const float step = 0x1p-12F;
    for (int s = 0; s < 17 * 17; ++s) {
      ahead.set(s, cloth.rest.at(s) + step * displacement.at(s));
      behind.set(s, cloth.rest.at(s) - step * displacement.at(s));
    }
    const Planes3 f1 = forces(cloth, ahead), f0 = forces(cloth, behind);
    const Planes3 image = forces(cloth, displacement, true);
    for (int s = 0; s < 17 * 17; ++s) {
      const Vec3f slope = (1 / (2 * step)) * (f1.at(s) - f0.at(s));
      EXPECT_LT(length(slope - image.at(s)), 5e-3 * largest(image)) << "sample " << s;
    }
  }
}

TEST(Bending, RotationsOfCurvedClothMeetNoResistance) {
  const Cloth cloth = torus_cloth(33, stiff);
  const Vec3f axis{1, 2, -1};
  Planes3 turn(33);
  for (int s = 0; s < 33 * 33; ++s) turn.set(s, cross(axis, cloth.rest.at(s)));
  Planes3 rough(33);
  shake(cloth, 1, rough);
  EXPECT_LT(largest(forces(cloth, turn, true)), 1e-5 * largest(forces(cloth, rough, true)));
}

TEST(Bending, BoundIsNotExceeded) {
  for (const Cloth& cloth :
       {flat_cloth(flat_sheet(9)), flat_cloth(uneven_sheet(9)), torus_cloth(9, stiff),
        flat_cloth(uneven_sheet(9), stiff_warp), torus_cloth(9, stiff_warp)}) {
    for (int seed = 1; seed <= 20; ++seed) {
      Planes3 displacement(9);
      shake(cloth, 1, displacement, seed);
      double bound = 0;
      for (int d = 0; d < spring_directions; ++d) {
        const Grid<float> edges = bending_bound(cloth, static_cast<SpringDirection>(d));
        const auto [down, right] = spring_offsets[d];
        for (int r = 0; r < 9; ++r)
          for (int c = 0; c < 9; ++c)
            if (edges(r, c) > 0)
              bound +=
                  edges(r, c) * squared_length(vec_cast<double>(
                                    displacement.at(r + down, c + right) - displacement.at(r, c)));
      }
      EXPECT_LT(-dot_product(cloth, displacement, forces(cloth, displacement, true)), bound);
    }
  }
}

TEST(Bending, CheckerboardMeetsItsBoundInside) {
  const Cloth cloth = flat_cloth(flat_sheet(9));
  const double d = 1.0 / 8;
  // One particle's part of M^T M of a checkerboard is B d^2 (8 / d^2)^2; of the edges, 8 k 8.
  const double exact = stiff.bending.warp * 64 / (d * d);
  EXPECT_NEAR(bending_bound(cloth, stretch_u)(4, 4) * 8, exact, 1e-4 * exact);
}

TEST(Bending, DiagonalIsThatOfTheMatrix) {
  Cloth torus = torus_cloth(9, stiff);
  torus.bending.curved = false;  // as if its normals did not turn
  for (const Cloth& cloth :
       {flat_cloth(uneven_sheet(9)), flat_cloth(uneven_sheet(9), stiff_warp), torus})
    for (const int sample : {0, 3, 8, 9, 12, 40, 63, 72, 80}) {
      const int first = cloth.mates.representative(sample);
      Planes3 unit(9);
      for (int s = 0; s < 81; ++s)
        if (cloth.mates.representative(s) == first) unit.set(s, {1, 0, 0});
      const double wanted = -forces(cloth, unit, true).x(first / 9, first % 9);
      EXPECT_NEAR(cloth.bending.diagonal(first / 9, first % 9), wanted, 1e-4 * wanted + 1e-9);
    }
}

TEST(Bending, AnyTeamGivesTheSameBits) {
  const Cloth cloth = torus_cloth(17, stiff);
  Planes3 p = cloth.rest;
  shake(cloth, 0.01, p);
  const auto hash = [&](int threads) {
    return hash_of({forces(cloth, p, false, threads), Planes3(17)});
  };
  EXPECT_EQ(hash(1), hash(3));
  EXPECT_EQ(hash(1), hash(7));
}

TEST(Bending, NoneWithoutStiffness) {
  const Cloth cloth = sheet_cloth(9, {.bending = 0});
  EXPECT_FALSE(BendingPass(cloth).active());
}

}  // namespace
}  // namespace weft
