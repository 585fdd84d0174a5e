// A warp that is not that of the rows.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/bending.h"
#include "weft/cloth/measure.h"

namespace weft {
namespace {

using testing::flat_sheet;
using testing::no_mates;

constexpr int side = 17;

Planes3 even(Vec3f direction) {
  Planes3 planes(side);
  for (int s = 0; s < side * side; ++s) planes.set(s, direction);
  return planes;
}

Cloth cut_sheet(const Material& material, Vec3f along) {
  const Planes3 rest = flat_sheet(side), warp = even(along);
  const BorderMates mates = no_mates(side);
  return make_cloth({rest, mates, nullptr, &warp}, material);
}

/// The elastic energy of a 1 m square that is stretched along x. [J]
double energy_of_stretch(const Cloth& cloth, float strain) {
  ClothState state = rest_state(cloth);
  for (int s = 0; s < side * side; ++s) {
    Vec3f p = state.position.at(s);
    p.x *= 1 + strain;
    state.position.set(s, p);
  }
  return potential_energy(cloth, state, {});
}

TEST(Grain, StretchGoesWithTheWarp) {
  const Material fabric{.stretch = {8000, 1000}, .shear = 0, .bending = 0};
  constexpr float strain = 0.01F;
  const auto energy = [&](Vec3f warp) {
    return energy_of_stretch(cut_sheet(fabric, warp), strain);
  };
  EXPECT_NEAR(energy({1, 0, 0}), 0.5 * 8000 * strain * strain, 0.4 * 0.01);
  EXPECT_NEAR(energy({0, 0, -3}), 0.5 * 1000 * strain * strain, 0.05 * 0.01);
  EXPECT_NEAR(energy({1, 0, 1}), 0.5 * 4500 * strain * strain, 0.225 * 0.01);
}

TEST(Grain, WarpAlongRowsChangesNothing) {
  const Material fabric{.stretch = {8000, 1000}, .bending = {4e-5, 1e-5}};
  const Cloth plain = make_cloth(flat_sheet(side), no_mates(side), fabric);
  for (const Vec3f along : {Vec3f{2, 0, 0}, Vec3f{0, 0, 0}}) {
    const Cloth cut = cut_sheet(fabric, along);
    for (int d = 0; d < spring_directions; ++d)
      for (int s = 0; s < side * side; ++s)
        EXPECT_EQ(cut.springs[d].stiffness(s / side, s % side),
                  plain.springs[d].stiffness(s / side, s % side));
    for (int k = 0; k < bending_neighbours; ++k)
      for (int s = 0; s < side * side; ++s)
        EXPECT_NEAR(cut.bending.weight[k](s / side, s % side),
                    plain.bending.weight[k](s / side, s % side), 1e-6);
  }
}

/// M x at the middle sample of a sheet that is bent to a parabola along a direction, over the
/// square root of the sample's area: L of the parabola.
double operator_on_parabola(const Cloth& cloth, Vec2d along) {
  const auto height = [&](int r, int c) {
    const Vec3f p = cloth.rest.at(r, c);
    const double way = along.x * p.x + along.y * p.z;
    return 0.5 * way * way;
  };
  const int r = side / 2 + 1, c = side / 2 + 2;
  double sum = 0;
  for (int k = 0; k < bending_neighbours; ++k) {
    const double weight = cloth.bending.weight[k](r, c);
    const auto [down, right] = bending_offsets[k];
    sum += weight * (height(r + down, c + right) - height(r, c));
  }
  return sum * (side - 1);
}

TEST(Grain, BendingGoesWithTheWarpAtAnyAngle) {
  const Material fabric{.stretch = 1000, .bending = {9e-5, 1e-5}};
  for (const double angle : {0.0, 0.3, pi / 4, 1.1, pi / 2}) {
    const Vec2d warp{cosine(angle), sine(angle)};
    const Cloth cloth =
        cut_sheet(fabric, {static_cast<float>(warp.x), 0, static_cast<float>(warp.y)});
    for (const double bent : {0.0, 0.7, 2.0}) {
      const double to_warp = cosine(bent - angle), to_weft = sine(bent - angle);
      const double wanted =
          std::sqrt(9e-5) * to_warp * to_warp + std::sqrt(1e-5) * to_weft * to_weft;
      EXPECT_NEAR(operator_on_parabola(cloth, {cosine(bent), sine(bent)}), wanted, 0.01 * wanted)
          << angle << " " << bent;
    }
  }
}

}  // namespace
}  // namespace weft
