#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"
#include "weft/core/json.h"
#include "weft/files.h"
#include "weft/run.h"
#include "weft/run/checkpoint.h"

namespace weft::resume_test {
namespace {

namespace fs = std::filesystem;

constexpr int frames = 8;

/// A hanging sheet and a ring that falls, over another ring.
Scene two_cloths(const IntegratorOptions& integrator = MultigridOptions{}) {
  Scene scene;
  scene.frames = frames;
  scene.substeps = 8;
  scene.integrator = integrator;
  SceneCloth sheet;
  sheet.name = "sheet";
  sheet.size = 17;
  sheet.placement.translate = {0, 0.4, 0};
  sheet.material.stretch = 50;  // so that the explicit method is stable
  sheet.material.shear = 10;
  sheet.material.strain_limit = 0.05;
  sheet.pins = {ImagePin{{0, 0}}, ImagePin{{1, 0}}};
  SceneCloth ring = sheet;
  ring.name = "ring";
  ring.surface = "builtin:torus";
  ring.placement.translate = {0, 0.03, 0};
  ring.pins.clear();
  scene.cloths = {sheet, ring};
  SceneBody body;
  body.name = "body";
  body.surface = "builtin:torus";
  body.size = 17;
  body.placement.scale = {0.5, 0.5, 0.5};
  body.placement.translate = {0.1, 0.25, 0.1};
  body.motion = {{0, {}, {}}, {0.1, {0, 30, 0}, {0, 0.02, 0}}};
  scene.bodies = {body};
  scene.cloths[0].attach = {{"body", ImagePin{{0.5, 1}}}};
  return scene;
}

/// Does something at a number of substeps, each of which reports once.
class AtSubstep : public Progress {
 public:
  AtSubstep(int substep, std::function<void()> action)
      : left_(substep), action_(std::move(action)) {}
  void update(std::string_view stage, double /*fraction*/) override {
    if (stage == "simulate" && left_-- == 0) action_();
  }

 private:
  int left_;
  std::function<void()> action_;
};

/// frames.csv without its times.
std::vector<std::string> untimed(const fs::path& csv) {
  std::istringstream in(read_file(csv));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    std::size_t comma = line.find(',');
    std::string kept = line.substr(0, comma);
    for (int column = 0; column < 5; ++column) comma = line.find(',', comma + 1);
    lines.push_back(kept + line.substr(comma));
  }
  return lines;
}

nlohmann::json untimed(const RunReport& report) {
  nlohmann::json json = parse_json(to_json(report), 9);
  json.erase("ms_per_frame");
  json.erase("outputs");
  return json;
}

void expect_same_files(const fs::path& one, const fs::path& other) {
  EXPECT_EQ(untimed(one / "frames.csv"), untimed(other / "frames.csv"));
  for (const char* name :
       {"sheet.pc2", "ring.pc2", "sheet.obj", "ring.obj", "body.obj", "sheet.exr"})
    EXPECT_EQ(read_file(one / name), read_file(other / name)) << name;
  std::set<std::string> names, others;
  for (const auto& entry : fs::directory_iterator(one)) names.insert(entry.path().filename());
  for (const auto& entry : fs::directory_iterator(other)) others.insert(entry.path().filename());
  EXPECT_EQ(names, others);
}

/// A folder as a process leaves it that is killed at the given substep.
void run_and_kill(const Scene& scene, const fs::path& folder, int substep) {
  const fs::path lost = folder.string() + "-lost";
  AtSubstep copy(substep, [&] { fs::copy(lost, folder, fs::copy_options::recursive); });
  run_scene(scene, "s.json", {.folder = lost, .progress = &copy, .checkpoint_frames = 2});
  ASSERT_FALSE(fs::exists(folder / "sheet.pc2"));
}

TEST(Resume, KilledRunEndsInTheSameBitsForEveryIntegrator) {
  for (const IntegratorOptions& integrator :
       {IntegratorOptions(ImplicitOptions{}), IntegratorOptions(ExplicitOptions{}),
        IntegratorOptions(DesbrunOptions{}), IntegratorOptions(TwoLevelOptions{.local_size = 5}),
        IntegratorOptions(MultigridOptions{})}) {
    SCOPED_TRACE(name_of(integrator));
    const test::TemporaryFolder place;
    const Scene scene = two_cloths(integrator);
    const RunReport whole = run_scene(scene, "s.json", {.folder = place / "whole"});
    EXPECT_GT(whole.contacts_max, 0);
    run_and_kill(scene, place / "run", 5 * scene.substeps + 3);
    const RunReport resumed =
        run_scene(scene, "s.json", {.folder = place / "run", .threads = 2, .resume = true});
    nlohmann::json wanted = untimed(whole);
    wanted["threads"] = 2;
    EXPECT_EQ(untimed(resumed), wanted);
    EXPECT_NE(resumed.notes.back().find("resumed after frame 4"), std::string::npos);
    expect_same_files(place / "whole", place / "run");
  }
}

TEST(Resume, KilledAtAnyFrameEndsTheSame) {
  const test::TemporaryFolder place;
  const Scene scene = two_cloths();
  run_scene(scene, "s.json", {.folder = place / "whole"});
  for (int frame = 0; frame < frames; ++frame) {
    const fs::path folder = place / ("run" + std::to_string(frame));
    run_and_kill(scene, folder, frame * scene.substeps + 1);
    run_scene(scene, "s.json", {.folder = folder, .resume = true});
    expect_same_files(place / "whole", folder);
  }
}

TEST(Resume, InterruptedRunLosesNoWholeFrame) {
  const test::TemporaryFolder place;
  const Scene scene = two_cloths();
  run_scene(scene, "s.json", {.folder = place / "whole"});
  AtSubstep stop(3 * scene.substeps + 2, [] { throw Interrupted(); });
  EXPECT_THROW(run_scene(scene, "s.json", {.folder = place / "run", .progress = &stop}),
               Interrupted);
  EXPECT_EQ(untimed(place / "run/frames.csv").size(), 4);
  EXPECT_EQ(read_checkpoint(checkpoint_path(place / "run"))->state.frame, 3);
  run_scene(scene, "s.json", {.folder = place / "run", .resume = true});
  expect_same_files(place / "whole", place / "run");
}

TEST(Resume, FinishedRunReportsTheSameAndGoesOnToMoreFrames) {
  const test::TemporaryFolder place;
  Scene scene = two_cloths();
  const RunReport first = run_scene(scene, "s.json", {.folder = place / "run"});
  const auto before = fs::last_write_time(place / "run/sheet.pc2");
  const RunReport again = run_scene(scene, "s.json", {.folder = place / "run", .resume = true});
  EXPECT_EQ(to_json(again), to_json(first));  // times, too
  EXPECT_NE(again.notes.back().find("finished already"), std::string::npos);
  EXPECT_EQ(fs::last_write_time(place / "run/sheet.pc2"), before);
  scene.frames = frames + 3;
  const RunReport longer = run_scene(scene, "s.json", {.folder = place / "run", .resume = true});
  EXPECT_EQ(untimed(longer), untimed(run_scene(scene, "s.json", {.folder = place / "whole"})));
  expect_same_files(place / "whole", place / "run");
}

TEST(Resume, NothingToResumeBeginsAndSaysSo) {
  const test::TemporaryFolder place;
  const Scene scene = two_cloths();
  const RunReport report = run_scene(scene, "s.json", {.folder = place / "run", .resume = true});
  EXPECT_EQ(report.frames, frames);
  EXPECT_NE(report.notes.back().find("nothing to resume"), std::string::npos);
}

TEST(Resume, NewRunForgetsTheOldOne) {
  const test::TemporaryFolder place;
  Scene scene = two_cloths();
  run_and_kill(scene, place / "run", 5 * scene.substeps);
  scene.substeps = 4;
  run_scene(scene, "s.json", {.folder = place / "run", .checkpoint_frames = 0});
  EXPECT_FALSE(fs::exists(checkpoint_path(place / "run")));
  for (const auto& entry : fs::directory_iterator(place / "run"))
    EXPECT_EQ(entry.path().filename().string().find(".part"), std::string::npos) << entry.path();
}

class Refused : public ::testing::Test {
 protected:
  void SetUp() override { run_and_kill(scene_, folder(), 5 * scene_.substeps); }
  [[nodiscard]] fs::path folder() const { return place_ / "run"; }
  /// What resuming says; nothing in the folder may have changed.
  [[nodiscard]] std::string refusal(const Scene& scene, RunOptions options = {}) const {
    const auto bytes = [&] {
      std::map<std::string, std::string> files;
      for (const auto& entry : fs::directory_iterator(folder()))
        files[entry.path().filename()] = read_file(entry.path());
      return files;
    };
    const auto before = bytes();
    options.folder = folder();
    options.resume = true;
    std::string message =
        test::message_of<InputError>([&] { run_scene(scene, "s.json", options); });
    EXPECT_TRUE(before == bytes());
    return message;
  }

  test::TemporaryFolder place_;
  Scene scene_ = two_cloths();
};

TEST_F(Refused, AnotherSceneIsNamedByItsKey) {
  Scene other = scene_;
  other.substeps = 9;
  EXPECT_NE(refusal(other).find("another scene: substeps is 8 there and 9 here"),
            std::string::npos);
  other = scene_;
  other.cloths[1].material.stretch = 51;
  EXPECT_NE(refusal(other).find("cloths/1/material/stretch is 50"), std::string::npos);
  other = scene_;
  other.bodies[0].motion[1].time = 0.2;
  EXPECT_NE(refusal(other).find("bodies/0/motion/1/time is 0.1 there and 0.2 here"),
            std::string::npos);
  EXPECT_NE(refusal(scene_, {.verify = true}).find("--verify"), std::string::npos);
  EXPECT_NE(refusal(scene_, {.unwelded = true}).find("--unwelded"), std::string::npos);
  EXPECT_NE(refusal(scene_, {.exports = {"obj"}}).find("--export"), std::string::npos);
}

TEST_F(Refused, FewerFramesThanThereAre) {
  Scene shorter = scene_;
  shorter.frames = 3;
  EXPECT_NE(refusal(shorter).find("is of frame 4; at least 4 frames"), std::string::npos);
}

TEST_F(Refused, DamagedCheckpoint) {
  const fs::path path = checkpoint_path(folder());
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary).seekp(1000).put('x');
  EXPECT_NE(refusal(scene_).find("weft-checkpoint.bin: is damaged"), std::string::npos);
  fs::resize_file(path, 1000);
  EXPECT_NE(refusal(scene_).find("weft-checkpoint.bin: is damaged"), std::string::npos);
}

TEST_F(Refused, CacheThatLacksFramesOrIsOfAnotherRun) {
  const fs::path part = temporary_path(folder() / "ring.pc2", TemporaryName::of_the_file);
  ASSERT_TRUE(fs::exists(part));
  const std::string whole = read_file(part);
  std::string changed = whole;
  changed[32 + 4 * 256 * 12 + 8] ^= 1;  // in frame 4
  std::ofstream(part, std::ios::binary) << changed;
  EXPECT_NE(refusal(scene_).find("ring.pc2: does not hold the 5 frames"), std::string::npos);
  fs::resize_file(part, 32 + 4 * 256 * 12);
  EXPECT_NE(refusal(scene_).find("ring.pc2: does not hold the 5 frames"), std::string::npos);
  std::ofstream(part, std::ios::binary) << whole;
  EXPECT_EQ(run_scene(scene_, "s.json", {.folder = folder(), .resume = true}).frames, frames);
}

TEST(Resume, ChangedMeshIsAnotherScene) {
  const test::TemporaryFolder place;
  const auto write_mesh = [&](double corner) {
    std::ofstream(place / "m.obj")
        << "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 " << corner << " 1\nf 1 2 3\nf 1 3 4\n";
  };
  write_mesh(0);
  Scene scene = two_cloths();
  scene.bodies[0].surface = place / "m.obj";
  run_scene(scene, "s.json", {.folder = place / "run"});
  const RunOptions resume{.folder = place / "run", .resume = true};
  write_mesh(1e-3);
  const std::string message =
      test::message_of<InputError>([&] { run_scene(scene, "s.json", resume); });
  EXPECT_NE(message.find("bodies/0/surface"), std::string::npos) << message;
  // The same mesh elsewhere is the same scene.
  write_mesh(0);
  fs::rename(place / "m.obj", place / "moved.obj");
  scene.bodies[0].surface = place / "moved.obj";
  EXPECT_EQ(run_scene(scene, "s.json", resume).frames, frames);
}

TEST(Resume, FullDiskKeepsWholeFramesAndTheRunGoesOnWhereThereIsRoom) {
  const test::TemporaryFolder place;
  Scene scene = two_cloths();
  scene.frames = 20;
  run_scene(scene, "s.json", {.folder = place / "whole"});
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  // Room for what does not grow and for 15 frames and a half of the sheet.
  const rlimit small{32 + 31 * 289 * 12 / 2, old.rlim_max};
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = test::message_of<OutputError>(
      [&] { run_scene(scene, "s.json", {.folder = place / "run", .checkpoint_frames = 3}); });
  setrlimit(RLIMIT_FSIZE, &old);
  (void)std::signal(SIGXFSZ, old_handler);
  EXPECT_NE(message.find("sheet.pc2: cannot be written whole"), std::string::npos) << message;
  EXPECT_EQ(fs::file_size(place / "run/sheet.pc2"), 32 + 15 * 289 * 12);
  EXPECT_EQ(untimed(place / "run/frames.csv").size(), 15);
  run_scene(scene, "s.json", {.folder = place / "run", .resume = true});
  expect_same_files(place / "whole", place / "run");
}

TEST(Resume, FolderInUseIsRefused) {
  const test::TemporaryFolder place;
  const Scene scene = two_cloths();
  AtSubstep second(20, [&] {
    EXPECT_THROW(run_scene(scene, "s.json", {.folder = place / "run", .resume = true}),
                 OutputError);
  });
  EXPECT_EQ(run_scene(scene, "s.json", {.folder = place / "run", .progress = &second}).frames,
            frames);
}

}  // namespace
}  // namespace weft::resume_test
