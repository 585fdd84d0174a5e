// The simulating thread, driven by commands alone: no window is needed.
#include "apps/viewer/simulator.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "weft/run.h"
#include "weft/scene_file.h"

namespace weft::viewer {
namespace {

constexpr int side = 17, middle = side / 2 * side + side / 2;

class Simulating : public ::testing::Test {
 protected:
  Simulating()
      : folder_(std::filesystem::temp_directory_path() /
                ("weft-simulator-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Simulating() override { std::filesystem::remove_all(folder_); }

  std::string scene(const std::string& more, int frame_rate = 1000) {
    const std::filesystem::path path = folder_ / ("scene" + std::to_string(++count_) + ".json");
    std::ofstream(path) << R"({"version": 1, "substeps": 1, "frame_rate": )" << frame_rate
                        << R"(, "cloths": [{"surface": "builtin:sheet", "size": 17, )"
                        << R"("translate": [0, 1, 0]}])" << more << "}";
    return path.string();
  }

  /// Waits for something that must come sooner or later.
  template <class Condition>
  void wait_for(Condition condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    simulator.update();
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), end) << simulator.status().error;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      simulator.update();
    }
  }
  void open(const std::string& subject) {
    simulator.push(Open{subject});
    wait_for([&] { return now().subject && now().subject->name == subject; });
  }
  [[nodiscard]] const Snapshot& now() const { return simulator.snapshot(); }
  [[nodiscard]] Scene shown() const { return *now().subject->scene; }

  std::filesystem::path folder_;
  int count_ = 0;
  Simulator simulator{{1, best_instruction_set(), true, 0, [] {}}};
};

TEST_F(Simulating, StepsAreCountedWhilePausedAndResetGoesBack) {
  open(scene(""));
  EXPECT_EQ(now().frame, 0);
  const double start = now().centre_of_mass.y;
  for (int i = 0; i < 5; ++i) simulator.push(StepOnce{});
  wait_for([&] { return now().frame == 5; });
  EXPECT_FALSE(now().running);
  EXPECT_LT(now().centre_of_mass.y, start);
  simulator.push(Reset{});
  wait_for([&] { return now().frame == 0; });
  EXPECT_EQ(now().centre_of_mass.y, start);
}

TEST_F(Simulating, PlaysUntilItIsPaused) {
  open(scene(""));
  simulator.push(Play{true});
  wait_for([&] { return now().frame > 20 && now().running; });
  simulator.push(Play{false});
  wait_for([&] { return !now().running; });
}

TEST_F(Simulating, WhatIsPulledAtRises) {
  open(scene(R"(, "gravity": [0, 0, 0])"));
  simulator.push(Grab{0, middle});
  simulator.push(Pull{{0, 2, 0}});
  simulator.push(Play{true});
  wait_for([&] { return now().held && now().cloths[0].at(middle).y > 1.5F; });
  simulator.push(LetGo{});
  wait_for([&] { return !now().held; });
}

TEST_F(Simulating, AChangedMaterialKeepsTheClothAndAnotherSizeDoesNot) {
  open(scene(""));
  for (int i = 0; i < 3; ++i) simulator.push(StepOnce{});
  wait_for([&] { return now().frame == 3; });
  const Planes3 before = now().cloths[0];
  Scene changed = shown();
  changed.cloths[0].material.stretch = 2 * changed.cloths[0].material.stretch.warp;
  changed.integrator = ImplicitOptions{};
  changed.collider = PolarMapOptions{};
  changed.substeps = 2;
  simulator.push(Change{changed, "another fabric"});
  wait_for([&] { return shown().substeps == 2; });
  EXPECT_EQ(now().frame, 3);
  EXPECT_EQ(now().cloths[0].at(5), before.at(5));
  EXPECT_FALSE(now().subject->frames_anew);
  changed.cloths[0].size = 9;
  simulator.push(Change{changed, "another size"});
  wait_for([&] { return now().cloths[0].size() == 9; });
  EXPECT_EQ(now().frame, 0);
}

TEST_F(Simulating, AChangeThatFailsIsToldAndEverythingGoesOn) {
  open(scene(""));
  Scene impossible = shown();
  impossible.integrator = TwoLevelOptions{4};
  simulator.push(Change{impossible, "even patches"});
  wait_for([&] { return !simulator.status().error.empty(); });
  simulator.push(StepOnce{});
  wait_for([&] { return now().frame == 1; });
}

TEST_F(Simulating, ARunawayIsOneLineAndResetGoesOn) {
  open(scene(R"(, "integrator": {"type": "explicit"}, "gravity": [3, -9.81, 0])", 60));
  simulator.push(Play{true});
  wait_for([&] { return !simulator.status().error.empty(); });
  EXPECT_NE(simulator.status().error.find("ran away"), std::string::npos);
  EXPECT_EQ(simulator.status().error.find('\n'), std::string::npos);
  simulator.push(Play{false});
  simulator.push(Reset{});
  wait_for([&] { return now().frame == 0; });
  EXPECT_TRUE(simulator.status().error.empty());
}

TEST_F(Simulating, AFileThatCannotBeReadIsOneLineAndTheNextOneOpens) {
  simulator.push(Open{(folder_ / "missing.json").string()});
  wait_for([&] { return !simulator.status().error.empty(); });
  EXPECT_NE(simulator.status().error.find("missing.json"), std::string::npos);
  open(scene(""));
  EXPECT_TRUE(simulator.status().error.empty());
}

TEST_F(Simulating, SurfacesAreShownAndDrapedOver) {
  open("builtin:torus");
  EXPECT_FALSE(now().subject->plays);
  EXPECT_EQ(now().cloths.size(), 1U);
  simulator.push(DrapeOver{"builtin:rod"});
  wait_for([&] { return now().subject->scene.has_value(); });
  EXPECT_EQ(now().subject->bodies.size(), 1U);
  EXPECT_EQ(shown().bodies[0].surface, "builtin:rod");
}

TEST_F(Simulating, EveryColouringColoursEverySample) {
  open(scene(""));
  simulator.push(StepOnce{});
  for (std::size_t by = 1; by < colour_names.size(); ++by) {
    const Colouring asked{static_cast<ColourBy>(by), 2};
    simulator.push(Recolour{asked});
    wait_for([&] { return now().colouring == asked; });
    EXPECT_EQ(now().colours[0].size(), side) << colour_names[by];
  }
  simulator.push(Recolour{{}});
  wait_for([&] { return now().colouring == Colouring{}; });
  EXPECT_EQ(now().colours[0].size(), 0);
}

TEST_F(Simulating, ClosingWhileItLoadsOrRunsEndsTheThread) {
  for (const bool runs : {false, true}) {
    Simulator other({1, best_instruction_set(), !runs, 0, [] {}});
    other.push(Open{runs ? scene("") : "builtin:genus20"});
  }
}

TEST_F(Simulating, StopsAtTheFrameThatItShallStopAt) {
  Simulator other({1, best_instruction_set(), false, 7, [] {}});
  other.push(Open{scene("")});
  while (!other.snapshot().subject || other.snapshot().running || other.snapshot().frame < 7) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    other.update();
  }
  EXPECT_EQ(other.snapshot().frame, 7);
}

TEST_F(Simulating, ARunIsPlayedAgainAndAgain) {
  const std::string path = scene(R"(, "frames": 3)");
  const std::string run = (folder_ / "run").string();
  run_scene(read_scene(path), path, {.folder = run});
  open(run);
  simulator.push(Play{true});
  int last = 0, rounds = 0;
  wait_for([&] {
    if (now().frame < last) ++rounds;
    last = now().frame;
    return rounds == 2;
  });
  EXPECT_TRUE(now().running);
}

TEST_F(Simulating, ARunIsColouredByItsStrain) {
  const std::string path = scene(R"(, "frames": 3)");
  const std::string run = (folder_ / "run").string();
  run_scene(read_scene(path), path, {.folder = run});
  open(run);
  const Colouring strain{ColourBy::strain};
  simulator.push(Recolour{strain});
  wait_for([&] { return now().colouring == strain; });
  ASSERT_EQ(now().colours.at(0).size(), side);
  const Vec3f colour = now().colours[0].at(middle);
  EXPECT_NEAR(colour.x, colour.z, 0.1) << "at rest it is neither red nor blue";
}

}  // namespace
}  // namespace weft::viewer
