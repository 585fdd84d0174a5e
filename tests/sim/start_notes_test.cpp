#include "weft/sim/loading/start_notes.h"

#include <gtest/gtest.h>

#include "weft/simulation.h"

namespace weft {
namespace {

/// All that is noted of a sheet of 9 x 9 samples, which is scaled and moved.
std::string notes_of(double scale, Vec3d translate) {
  Scene scene;
  scene.cloths.resize(1);
  scene.cloths[0].size = 9;
  scene.cloths[0].placement.scale = {scale, scale, scale};
  scene.cloths[0].placement.translate = translate;
  const Simulation simulation(scene, "scene", 1);
  std::string all;
  for (const std::string& note : simulation.notes()) all += note;
  return all;
}

Box3d cube(double side) { return {{0, 0, 0}, {side, side, side}}; }

TEST(StartNotes, ClothFarFromTheOriginIsTold) {
  EXPECT_EQ(notes_of(1, {0.3, 1, -1000}), "");
  EXPECT_NE(notes_of(1, {0.3, 1, -30000}).find("begins 3e+04 m from the origin"),
            std::string::npos);
}

TEST(StartNotes, ClothAsWideAsThickIsTold) {
  EXPECT_EQ(notes_of(0.05, {0, 1, 0}), "");
  EXPECT_NE(notes_of(0.001, {0, 1, 0}).find("is 0.001 m across, with a thickness"),
            std::string::npos);
}

TEST(StartNotes, BodiesUnlikeAllClothAreTold) {
  const Box3d cloths[] = {cube(0.02), cube(1)};
  EXPECT_EQ(unlike_text(cube(1.8), cloths), "");
  EXPECT_EQ(unlike_text(cube(0.01), cloths), "");
  EXPECT_EQ(unlike_text(cube(170), {}), "");
  EXPECT_EQ(unlike_text(cube(170), cloths),
            "is 170 m across, and cloth 1 m: is the unit of its file right?");
  EXPECT_NE(unlike_text(cube(0.0001), cloths), "");
}

TEST(StartNotes, GarmentsThatNobodyCanWearAreTold) {
  const Box3d bodies[] = {cube(0.3), cube(1.8)};
  EXPECT_EQ(unfit_text(cube(3), bodies), "");
  EXPECT_EQ(unfit_text(cube(0.1), bodies), "");
  EXPECT_EQ(unfit_text(cube(100), {}), "");
  EXPECT_EQ(unfit_text(cube(4.5), bodies),
            "is 4.5 m across, and the largest body 1.8 m: is units_in_meter of its pattern right?");
  EXPECT_NE(unfit_text(cube(0.05), bodies), "");
  EXPECT_EQ(unwearable_text(cube(4.5), bodies) + unwearable_text(cube(0.05), bodies), "");
  EXPECT_EQ(unwearable_text(cube(10), bodies), "is 10 m across, and the largest body 1.8 m");
  EXPECT_NE(unwearable_text(cube(0.01), bodies), "");
  EXPECT_EQ(unwearable_text(cube(100), {}), "");
}

}  // namespace
}  // namespace weft
