#include "weft/sim/sewing/gathers.h"

#include <ostream>

#include <gtest/gtest.h>

#include "tests/support/patterns.h"
#include "tests/support/temporary_folder.h"
#include "weft/cloth/measure.h"
#include "weft/files.h"
#include "weft/simulation.h"

namespace weft {
namespace {

/// A flounce of 34 cm on a band of 20 cm.
class Gathered : public ::testing::Test {
 protected:
  Gathered() {
    write_file(folder_ / "p.json", [](std::ostream& out) { out << test::band_and_flounce(34); });
    SceneCloth cloth;
    cloth.name = "flounce";
    cloth.surface = (folder_ / "p.json").string();
    cloth.spacing = 0.02;
    scene_.cloths = {cloth};
    scene_.ground.reset();
  }
  /// The length of the seam. [m]
  static double seam_length(const Simulation& simulation) {
    const SimulatedCloth& cloth = simulation.cloths()[0];
    double sum = 0;
    const auto& pairs = cloth.garment->seams.front().pairs;
    for (std::size_t i = 1; i < pairs.size(); ++i)
      sum += length(vec_cast<double>(cloth.state.position.at(pairs[i][0]) -
                                     cloth.state.position.at(pairs[i - 1][0])));
    return sum;
  }
  test::TemporaryFolder folder_;
  Scene scene_;
};

TEST_F(Gathered, ASeamIsAsLongAsTheShorterEdge) {
  Simulation simulation(scene_, "scene", 1);
  FrameReport report;
  double strain = 0;
  for (report.seam_gap = 1; report.seam_gap > 0 && simulation.frame() < 100;) {
    report = simulation.advance();
    strain = std::max(strain, report.strain.p99);
  }
  EXPECT_EQ(report.seam_gap, 0);
  EXPECT_LT(strain, 0.1) << "on the way";
  for (int frame = 0; frame < 20; ++frame) report = simulation.advance();
  EXPECT_NEAR(seam_length(simulation), 0.2, 0.004);
  EXPECT_LT(report.strain.p99, 0.02);
}

TEST_F(Gathered, WhatGatheringAddsIsWork) {
  Simulation simulation(scene_, "scene", 1);
  FrameReport report = simulation.advance();
  const double start = report.kinetic_energy + report.potential_energy - report.work;
  double work = report.work, gained = 0;
  while (simulation.frame() < 60) {
    report = simulation.advance();
    work += report.work;
    gained = std::max(gained, report.kinetic_energy + report.potential_energy - start - work);
  }
  const double area = 0.2 * 0.06 + 0.34 * 0.15;
  const double weight = 9.81 * area * simulation.cloths()[0].model->material.density;
  EXPECT_GT(work, weight * 0.1) << "sewing and gathering do some";
  EXPECT_LT(gained, 0.01 * weight);
}

TEST_F(Gathered, GoesOnFromASavedState) {
  Simulation whole(scene_, "scene", 1), resumed(scene_, "scene", 1);
  SimulationState state;
  for (int frame = 0; frame < 30; ++frame) {
    if (frame == 5) {
      whole.save(state);
      resumed.restore(state);
    }
    const double work = whole.advance().work;
    if (frame < 5) continue;
    EXPECT_EQ(resumed.advance().work, work) << frame;
  }
  EXPECT_EQ(whole.state_hash(), resumed.state_hash());
}

TEST_F(Gathered, LengthsGoFromThoseOfTheFlatPanelsToTheShorter) {
  Simulation simulation(scene_, "scene", 1);
  Cloth cloth = *simulation.cloths()[0].model;
  const double flat = measure_strain(cloth, rest_state(cloth)).max;
  EXPECT_LT(flat, 1e-3) << "panels begin at rest";
  cloth = make_cloth({cloth.rest, cloth.mates, nullptr, nullptr}, cloth.material);
  const Cloth sewn = cloth;
  Gathers gathers(cloth);
  const Planes3& position = simulation.cloths()[0].state.position;
  const auto energy = [&](const Cloth& of) {
    return potential_energy(of, {position, Planes3(position.size())}, {});
  };
  const double before = energy(cloth);
  EXPECT_FALSE(gathers.gather(0, cloth));
  EXPECT_TRUE(gathers.gather(0.5, cloth));
  const double half = energy(cloth);
  EXPECT_NEAR(gathers.work(0, 0.5, cloth, position), half - before, 1e-4 * half);
  EXPECT_TRUE(gathers.gather(1, cloth));
  EXPECT_FALSE(gathers.gather(1, cloth));
  EXPECT_GT(energy(cloth), half);
  for (const SpringDirection direction : {stretch_u, stretch_v})
    for (int r = 0; r < cloth.size; ++r)
      for (int c = 0; c < cloth.size; ++c)
        EXPECT_EQ(cloth.springs[direction].rest_length(r, c),
                  sewn.springs[direction].rest_length(r, c));
}

}  // namespace
}  // namespace weft
