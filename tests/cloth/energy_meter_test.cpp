#include "weft/cloth/energy_meter.h"

#include <gtest/gtest.h>

#include "weft/cloth/measure.h"
#include "weft/convert.h"
#include "weft/core/random.h"

namespace weft {
namespace {

const Vec3d gravity{1, -9.81, 0.5};

GeometryImage torus() {
  ConvertOptions options;
  options.size = 33;
  return load_surface("builtin:torus", options).image;
}

/// A shaken torus, whose borders are seams.
struct Shaken {
  GeometryImage image;
  Cloth cloth;
  ClothState state;

  Shaken() : image(torus()) {
    Material material;
    material.bend_springs = 1;
    cloth = make_cloth(world_positions(image), image.mates, material);
    state = rest_state(cloth);
    Random random(3);
    for (int s = 0; s < 33 * 33; ++s) {
      if (image.mates.representative(s) != s) continue;
      const auto shake = [&](float size) {
        return Vec3f{static_cast<float>(random.uniform(-size, size)),
                     static_cast<float>(random.uniform(-size, size)),
                     static_cast<float>(random.uniform(-size, size))};
      };
      state.position.set(s, state.position.at(s) + shake(0.01F));
      state.velocity.set(s, Vec3f{3, 0, 0} + shake(1));
    }
    for (int s = 0; s < 33 * 33; ++s) {
      state.position.set(s, state.position.at(image.mates.representative(s)));
      state.velocity.set(s, state.velocity.at(image.mates.representative(s)));
    }
  }
};

TEST(EnergyMeter, AgreesWithTheMeasuresInDoublePrecision) {
  const Shaken shaken;
  ThreadTeam team(2);
  EnergyMeter meter(shaken.cloth, gravity, team);
  const Energy energy = meter.measure(shaken.state);
  const double kinetic = kinetic_energy(shaken.cloth, shaken.state);
  const double elastic = potential_energy(shaken.cloth, shaken.state, {});
  const double potential = potential_energy(shaken.cloth, shaken.state, gravity);
  EXPECT_NEAR(energy.kinetic, kinetic, 1e-6 * kinetic);
  EXPECT_NEAR(energy.elastic, elastic, 1e-5 * elastic);
  EXPECT_NEAR(energy.gravity, potential - elastic, 1e-5 * std::abs(potential - elastic));
}

TEST(EnergyMeter, TeamsOfAnySizeAndInstructionSetsGiveTheSameBits) {
  const Shaken shaken;
  const auto measured = [&](const TeamOptions& options) {
    ThreadTeam team(options);
    EnergyMeter meter(shaken.cloth, gravity, team);
    const Energy energy = meter.measure(shaken.state);
    return std::array{energy.kinetic, energy.elastic, energy.gravity};
  };
  const auto one = measured({1, InstructionSet::baseline});
  for (const int threads : {1, 2, 3, 7}) EXPECT_EQ(measured({threads}), one);
}

TEST(EnergyMeter, TakesOutMotionThatIsNotTheMean) {
  Shaken shaken;
  ThreadTeam team(1);
  EnergyMeter meter(shaken.cloth, gravity, team);
  const Energy before = meter.measure(shaken.state);
  EXPECT_NEAR(before.drift, 0.5 * meter.mass() * 9, 0.05 * before.drift);
  const double wanted = 0.25 * (before.kinetic - before.drift);
  EXPECT_NEAR(meter.take_out(wanted, shaken.state.velocity), wanted, 1e-9);
  const Energy after = meter.measure(shaken.state);
  EXPECT_NEAR(after.kinetic, before.kinetic - wanted, 1e-6 * before.kinetic);
  EXPECT_NEAR(after.drift, before.drift, 1e-6 * before.drift);
  // What all share stays, whatever is wanted.
  EXPECT_LT(meter.take_out(10 * before.kinetic, shaken.state.velocity), before.kinetic);
  EXPECT_NEAR(meter.kinetic(shaken.state.velocity), before.drift, 1e-6 * before.drift);
}

}  // namespace
}  // namespace weft
