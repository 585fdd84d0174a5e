// The strain of recorded cloth is what the simulation had.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/support/tube_scene.h"
#include "weft/convert.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/image_file.h"
#include "weft/run.h"
#include "weft/run_folder.h"
#include "weft/simulation.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr int recorded_frames = 12;

Scene hanging(Vec3d scale) {
  SceneCloth sheet;
  sheet.name = "sheet";
  sheet.size = 17;
  sheet.placement.scale = scale;
  sheet.placement.translate = {0.3, 2, -0.1};
  sheet.placement.rotate = {20, 70, 10};
  sheet.pins = {ImagePin{{0, 0}}, ImagePin{{1, 0}}};
  Scene scene;
  scene.frames = recorded_frames;
  scene.ground.reset();
  scene.cloths = {sheet};
  return scene;
}

/// The largest of a cloth's strains at the last frame. Fails where the folder tells of others.
double expect_same_strains(const Scene& scene) {
  const test::TemporaryFolder place;
  run_scene(scene, "s.json", {.folder = place / "run"});
  Simulation again(scene, "s.json", 1);
  for (int frame = 0; frame < scene.frames; ++frame) again.advance();
  const RunFolder run = open_run_folder(place / "run");
  const int n = run.cloths[0].image.size();
  Grid<float> strains(n, n);
  again.strain_at_samples(0, strains);
  const Grid<float> told =
      RecordedStrain(run.cloths[0]).at_samples(run.cloths[0].recorded.positions(scene.frames));
  double largest = 0;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      // Placing a surface 2 m away rounds what lies 2 cm apart.
      EXPECT_NEAR(told(r, c), strains(r, c), 3e-5) << r << " " << c;
      largest = std::max<double>(largest, std::abs(strains(r, c)));
    }
  return largest;
}

TEST(RecordedStrain, IsThatOfASheet) { EXPECT_GT(expect_same_strains(hanging({1, 1, 1})), 1e-4); }

TEST(RecordedStrain, IsThatOfACurvedSurface) {
  Scene scene = hanging({1, 1, 1});
  scene.cloths[0].surface = "builtin:torus";
  scene.cloths[0].pins = {ImagePin{{0, 0}}};
  EXPECT_GT(expect_same_strains(scene), 1e-6);
}

TEST(RecordedStrain, KnowsTheScale) {
  const double largest = expect_same_strains(hanging({2, 1, 0.5}));
  EXPECT_GT(largest, 1e-4);
  EXPECT_LT(largest, 0.2) << "of a rest shape of another scale it would be 0.5 and more";
}

TEST(RecordedStrain, KnowsFlatPanels) {
  const test::TemporaryFolder patterns;
  Scene scene;
  scene.frames = recorded_frames;
  scene.ground.reset();
  scene.cloths = {test::tube_cloth(patterns / "tube.json", 30, 20, 0.03)};
  scene.bodies = {test::ball_in_tube(1.1, 17)};
  EXPECT_GT(expect_same_strains(scene), 1e-4);
}

TEST(RecordedStrain, KnowsGathers) {
  const test::TemporaryFolder patterns;
  write_file(patterns / "p.json", [](std::ostream& out) { out << test::band_and_flounce(34); });
  Scene scene;
  scene.frames = 30;
  scene.ground.reset();
  SceneCloth cloth;
  cloth.name = "flounce";
  cloth.surface = (patterns / "p.json").string();
  cloth.spacing = 0.03;
  scene.cloths = {cloth};
  EXPECT_LT(expect_same_strains(scene), 0.1) << "of flat panels it would be 0.4";
}

TEST(RecordedStrain, NeedsWhatTheRunWrote) {
  const test::TemporaryFolder place;
  const fs::path folder = place / "run";
  run_scene(hanging({2, 1, 0.5}), "s.json", {.folder = folder});
  const fs::path rest = folder / "sheet.rest.exr";
  ConvertOptions larger;
  larger.size = 33;
  write_image(rest, load_surface(Surface("builtin:sheet"), larger).image);
  EXPECT_THROW(open_run_folder(folder), InputError) << "of another size";
  fs::remove(rest);
  EXPECT_THROW(open_run_folder(folder), InputError);
  std::string manifest = read_file(folder / "weft-run.json");
  const auto at = manifest.find("\"rest\"");
  ASSERT_NE(at, std::string::npos);
  manifest.erase(at, manifest.find('\n', at) - at);
  write_file(folder / "weft-run.json", [&](std::ostream& out) { out << manifest; });
  EXPECT_EQ(open_run_folder(folder).cloths[0].rest.size(), 0) << "as older folders";
  run_scene(hanging({1, 1, 1}), "s.json", {.folder = folder});
  EXPECT_FALSE(fs::exists(rest));
}

}  // namespace
}  // namespace weft
