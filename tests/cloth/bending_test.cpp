#include "weft/cloth/bending.h"

#include <gtest/gtest.h>

#include "tests/cloth/bent_sheets.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

using namespace testing;

TEST(Bending, AffineMapsOfFlatClothFeelNone) {
  const auto affine = [](Vec3d p) {
    return Vec3d{1.3 * p.x + 0.2 * p.z, 0.4 * p.x - 0.7 * p.z + 0.1, 0.8 * p.z - 0.3 * p.x};
  };
  for (const Material& material : {stiff, stiff_warp})
    for (const Planes3& rest : {flat_sheet(17), uneven_sheet(17), disk(17)}) {
      const Cloth cloth = flat_cloth(rest, material);
      EXPECT_FALSE(cloth.bending.curved);
      EXPECT_LT(largest(forces(cloth, mapped(rest, affine))), force_of_a_hair(cloth));
    }
}

TEST(Bending, LaplacianDoesNotDependOnTheParameterization) {
  // y = x^2 / 2 + x z / 3 + z^2 has the Laplacian 3 and the Gaussian curvature 2 - 1/9.
  const auto bowl = [](Vec3d p) {
    return Vec3d{p.x, 0.5 * p.x * p.x + p.x * p.z / 3 + p.z * p.z, p.z};
  };
  for (const Planes3& rest : {flat_sheet(65), uneven_sheet(65), disk(65)}) {
    const Cloth cloth = flat_cloth(rest);
    const double area = total_mass(cloth) / cloth.material.density;
    const double energy = bending_energy(cloth, mapped(rest, bowl));
    // Along the border only the second derivative there counts.
    const double density = 0.5 * stiff.bending.warp * (9 - 2 * 0.75 * (2 - 1.0 / 9));
    EXPECT_NEAR(energy / (density * area), 1, 0.05);
  }
}

TEST(Bending, RegularGridNeedsItsStraightNeighboursAlone) {
  EXPECT_FALSE(flat_cloth(flat_sheet(41)).bending.diagonals);
  EXPECT_TRUE(flat_cloth(uneven_sheet(41)).bending.diagonals);
}

TEST(Bending, RolledStripHasTheEnergyOfItsCurvature) {
  // A cylinder of radius 1/2: B/2 4 on all of the area but half a row at either end.
  const int n = 33;
  const Cloth cloth = flat_cloth(flat_sheet(n));
  const auto roll = [](Vec3d p) { return Vec3d{0.5 * sine(2 * p.x), -0.5 * cosine(2 * p.x), p.z}; };
  const double energy = bending_energy(cloth, mapped(cloth.rest, roll));
  const double wanted = 0.5 * stiff.bending.warp * 4 * (1 - 1.0 / (n - 1));
  EXPECT_NEAR(energy / wanted, 1, 1e-3);
}

TEST(Bending, NoShapeHasNegativeEnergy) {
  // The lowest eigenvalue, by the powers of what the highest one is more than the matrix.
  const auto narrow = [](Vec3d p) { return Vec3d{p.x, 0, 0.25 * p.z}; };
  std::vector<Cloth> cloths{flat_cloth(flat_sheet(9), stiff_warp),
                            flat_cloth(uneven_sheet(9), stiff_warp)};
  for (const Planes3& rest :
       {flat_sheet(9), uneven_sheet(9), disk(9), uneven_sheet(17), mapped(flat_sheet(9), narrow)})
    cloths.push_back(flat_cloth(rest));
  for (const Cloth& cloth : cloths) {
    Planes3 displacement(cloth.size);
    shake(cloth, 1, displacement);
    const auto normalize = [&](Planes3& planes) {
      const auto scale = static_cast<float>(1 / std::sqrt(dot_product(cloth, planes, planes)));
      for (int s = 0; s < cloth.size * cloth.size; ++s) planes.set(s, scale * planes.at(s));
    };
    const auto power = [&](double shift, int count) {
      double value = 0;
      for (int i = 0; i < count; ++i) {
        normalize(displacement);
        const Planes3 image = forces(cloth, displacement, true);
        value = -dot_product(cloth, displacement, image);
        for (int s = 0; s < cloth.size * cloth.size; ++s)
          displacement.set(s, static_cast<float>(shift) * displacement.at(s) + image.at(s));
      }
      return value;
    };
    const double highest = power(0, 50);
    shake(cloth, 1, displacement, 2);
    EXPECT_GT(power(0.6 * highest, 2000), -1e-5 * highest);
  }
}

}  // namespace
}  // namespace weft
