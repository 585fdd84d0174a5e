#include "weft/cloth/strain_stiffening.h"

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/energy_meter.h"
#include "weft/core/random.h"

namespace weft {
namespace {

using namespace testing;

constexpr int size = 9;

Material limited() {
  Material material;
  material.strain_limit = 0.02;
  return material;
}

double limit_energy(const Cloth& cloth, const Planes3& positions) {
  double energy = 0;
  for (int r = 0; r < cloth.size; ++r) energy += strain_limit_energy(cloth, positions, r);
  return energy;
}

/// A sheet that is longer along x by 5 % in all, and shorter along z.
TEST(StrainStiffening, HoldsWhatTenTimesTheSpringsHoldBeyondTheLimit) {
  const Cloth cloth = sheet_cloth(size, limited());
  ClothState state = rest_state(cloth);
  for (int s = 0; s < size * size; ++s) {
    const Vec3f p = state.position.at(s);
    state.position.set(s, {1.05F * p.x, p.y, 0.9F * p.z});
  }
  double own = 0;
  for (const int d : {stretch_u, stretch_v}) {
    const SpringPlane& springs = cloth.springs[d];
    if (springs.right == 0) continue;  // along z
    for (int r = 0; r < size; ++r)
      for (int c = 0; c + 1 < size; ++c) {
        const double over = 0.03 * springs.rest_length(r, c);
        own += 0.5 * 10 * springs.stiffness(r, c) * over * over;
      }
  }
  EXPECT_GT(own, 0);
  EXPECT_NEAR(limit_energy(cloth, state.position), own, 1e-4 * own);
  ThreadTeam team(1);
  const double with = EnergyMeter(cloth, {}, team, true).measure(state).elastic;
  const double without = EnergyMeter(cloth, {}, team).measure(state).elastic;
  EXPECT_NEAR(with - without, own, 1e-3 * own);
}

TEST(StrainStiffening, ForcesAreTheDescentOfItsEnergy) {
  const Cloth cloth = sheet_cloth(size, limited());
  ClothState state = rest_state(cloth);
  Random random(4);
  const float spacing = static_cast<float>(cloth.rest_spacing);
  for (int s = 0; s < size * size; ++s) {
    const auto shake = [&] { return 0.2F * spacing * static_cast<float>(random.uniform(-1, 1)); };
    state.position.set(s, state.position.at(s) + Vec3f{shake(), shake(), shake()});
  }
  Planes3 forces(size);
  add_strain_limit_forces(cloth, state.position, forces);
  const float h = 1e-3F * spacing;
  double largest = 0;
  for (int s = 0; s < size * size; ++s)
    for (const Vec3f axis : {Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, 0, 1}}) {
      const Vec3f at = state.position.at(s);
      state.position.set(s, at + h * axis);
      const Vec3f ahead = state.position.at(s);
      const double more = limit_energy(cloth, state.position);
      state.position.set(s, at - h * axis);
      const double step =
          dot(vec_cast<double>(ahead - state.position.at(s)), vec_cast<double>(axis));
      const double slope = (more - limit_energy(cloth, state.position)) / step;
      state.position.set(s, at);
      const double force = dot(forces.at(s), axis);
      largest = std::max(largest, std::abs(force));
      EXPECT_NEAR(force, -slope, 0.02 * std::abs(slope) + 0.5) << s;
    }
  EXPECT_GT(largest, 50);
}

}  // namespace
}  // namespace weft
