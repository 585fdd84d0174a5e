#include "weft/run.h"

#include <cstdint>
#include <cstring>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"
#include "weft/core/json.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/mesh.h"
#include "weft/run/export/point_cache_writers.h"
#include "weft/run_folder.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

Scene ring(int frames) {
  Scene scene;
  scene.frames = frames;
  SceneCloth cloth;
  cloth.name = "ring";
  cloth.surface = "builtin:torus";
  cloth.size = 17;
  cloth.placement.translate = {0, 0.3, 0};
  scene.cloths = {cloth};
  SceneBody body;
  body.name = "plate";
  body.surface = "builtin:sheet";
  body.size = 17;
  body.placement.translate = {0, 0.01, 0};
  scene.bodies = {body};
  return scene;
}

/// Stops after a number of substeps, each of which reports once.
class Stopper : public Progress {
 public:
  explicit Stopper(int substeps) : left_(substeps) {}
  void update(std::string_view stage, double /*fraction*/) override {
    if (stage == "simulate" && left_-- == 0) throw Interrupted();
  }

 private:
  int left_;
};

template <class T>
T value_at(const std::string& bytes, std::size_t offset) {
  T value{};
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

TEST(Pc2, BytesAreTheFormats) {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "two.pc2";
  Pc2Writer writer(path, 2);
  writer.add(std::vector<Vec3f>{{1, 2, 3}, {4, 5, 6}});
  writer.add(std::vector<Vec3f>{{7, 8, 9}, {10, 11, 12}});
  writer.add(std::vector<Vec3f>{{0, 0, 0}, {0.5F, -1, 0}});
  EXPECT_TRUE(!fs::exists(path) || fs::remove(path));
  writer.finish();
  const std::string bytes = read_file(path);
  ASSERT_EQ(bytes.size(), 32 + 3 * 2 * 12);
  EXPECT_EQ(bytes.substr(0, 12), std::string("POINTCACHE2\0", 12));
  EXPECT_EQ(value_at<std::int32_t>(bytes, 12), 1);
  EXPECT_EQ(value_at<std::int32_t>(bytes, 16), 2);
  EXPECT_EQ(value_at<float>(bytes, 20), 0.0F);
  EXPECT_EQ(value_at<float>(bytes, 24), 1.0F);
  EXPECT_EQ(value_at<std::int32_t>(bytes, 28), 3);
  EXPECT_EQ(value_at<float>(bytes, 32 + 24 + 12), 10.0F);
  EXPECT_EQ(value_at<float>(bytes, 32 + 48 + 16), -1.0F);
}

TEST(Run, LeavesMeshAndCacheOfOneVertexOrder) {
  const test::TemporaryFolder place;
  const fs::path folder = place / "run";
  const RunReport report = run_scene(ring(3), "ring.json", {.folder = folder});
  EXPECT_EQ(report.frames, 3);
  EXPECT_EQ(report.centre_of_mass.size(), 4);
  const TriangleMesh mesh = read_mesh(folder / "ring.obj");
  const std::string cache = read_file(folder / "ring.pc2");
  // Rows and columns of the torus wrap: 16 x 16 points.
  ASSERT_EQ(mesh.positions.size(), 256);
  EXPECT_EQ(mesh.triangles.size(), 512);
  EXPECT_EQ(value_at<std::int32_t>(cache, 16), 256);
  EXPECT_EQ(value_at<std::int32_t>(cache, 28), 4);
  for (int v = 0; v < 256; ++v) {
    EXPECT_EQ(value_at<float>(cache, 32 + 12 * v), static_cast<float>(mesh.positions[v].x));
    EXPECT_EQ(value_at<float>(cache, 36 + 12 * v), static_cast<float>(mesh.positions[v].y));
  }
  for (const auto& path : report.outputs) EXPECT_TRUE(fs::exists(path)) << path;
}

TEST(Run, UnweldedKeepsEverySample) {
  const test::TemporaryFolder place;
  const fs::path folder = place / "run";
  run_scene(ring(1), "ring.json", {.folder = folder, .unwelded = true});
  EXPECT_EQ(read_mesh(folder / "ring.obj").positions.size(), 17 * 17);
  EXPECT_EQ(value_at<std::int32_t>(read_file(folder / "ring.pc2"), 16), 17 * 17);
}

TEST(Run, FolderOpensAgainWithTheSamePositions) {
  const test::TemporaryFolder place;
  const fs::path folder = place / "run";
  const Scene scene = ring(2);
  run_scene(scene, "ring.json", {.folder = folder});
  Simulation again(scene, "ring.json", 1);
  again.advance();
  const RunFolder run = open_run_folder(folder);
  EXPECT_EQ(run.frames, 3);
  EXPECT_EQ(run.frame_rate, 60);
  EXPECT_EQ(run.ground, 0.0);
  const Planes3 positions = run.cloths.at(0).recorded.positions(1);
  for (int s = 0; s < 17 * 17; ++s)
    EXPECT_EQ(positions.at(s), again.cloths()[0].state.position.at(s));
  ASSERT_EQ(run.bodies.size(), 1);
  EXPECT_EQ(run.bodies[0].positions.at(5, 5), again.bodies()[0].positions.at(5, 5));
  EXPECT_THROW((void)run.cloths[0].recorded.positions(3), UsageError);
}

TEST(Run, BodiesThatMoveAreRecordedFrameByFrame) {
  const test::TemporaryFolder place;
  const fs::path folder = place / "run";
  Scene scene = ring(2);
  scene.bodies[0].motion = {{0, {}, {0, 0.5, 0}}, {1, {}, {6, 0.5, 0}}};
  run_scene(scene, "ring.json", {.folder = folder});
  const RunFolder run = open_run_folder(folder);
  ASSERT_EQ(run.bodies.size(), 1);
  const Vec3f rest = run.bodies[0].positions.at(5, 5);
  for (int frame = 0; frame <= 2; ++frame) {
    const Vec3f there = run.bodies[0].positions_at(frame).at(5, 5);
    EXPECT_NEAR(there.x, rest.x + 0.1F * static_cast<float>(frame), 1e-6);
    EXPECT_EQ(there.y, rest.y + 0.5F);
  }
  const TriangleMesh start = read_mesh(folder / "plate.obj");
  EXPECT_EQ(value_at<float>(read_file(folder / "plate.pc2"), 32),
            static_cast<float>(start.positions[0].x));
  fs::remove(folder / "plate.pc2");
  EXPECT_THROW(open_run_folder(folder), InputError);
}

/// A ball that flies into a hanging sheet, many times the gap that is kept in a substep.
Scene hit_sheet(double speed) {
  Scene scene;
  scene.frames = 14;
  scene.ground.reset();
  SceneCloth sheet;
  sheet.size = 33;
  sheet.placement.rotate = {90, 0, 0};
  sheet.pins = {RegionPin{{0, 0}, {1, 0}}};
  scene.cloths = {sheet};
  SceneBody ball;
  ball.surface = "builtin:sphere";
  ball.size = 33;
  ball.placement = {{0.4, 0.4, 0.4}, {}, {0, 0, -0.3}};
  ball.motion = {{0.05, {}, {}}, {0.05 + 0.8 / speed, {}, {0, 0, 0.8}}};
  scene.bodies = {ball};
  return scene;
}

TEST(Run, FastBodiesPushClothAndDoNotPassIt) {
  const test::TemporaryFolder place;
  const RunReport report =
      run_scene(hit_sheet(6), "hit.json", {.folder = place / "run", .verify = true});
  EXPECT_EQ(report.intersections.counts.total(), 0);
  EXPECT_GT(report.centre_of_mass.back().z, 0.1);
  ASSERT_TRUE(report.verification);
  EXPECT_TRUE(report.verification->good());
  EXPECT_TRUE(report.notes.empty()) << report.notes[0];
}

/// Two sheets that fly through each other within a frame; nothing keeps them apart.
Scene flying_through() {
  Scene scene;
  scene.frames = 2;
  scene.ground.reset();
  scene.gravity = {};
  scene.collider = PolarMapOptions{};
  SceneCloth sheet;
  sheet.name = "low";
  sheet.size = 9;
  scene.cloths = {sheet, sheet};
  scene.cloths[1].name = "high";
  scene.cloths[1].placement.translate = {0.01, 0.25, 0.02};
  scene.cloths[1].velocity = {0, -30, 0};
  return scene;
}

TEST(Run, VerifySeesWhatPassesBetweenFrames) {
  const test::TemporaryFolder place;
  const RunReport report =
      run_scene(flying_through(), "through.json", {.folder = place / "run", .verify = true});
  EXPECT_EQ(report.intersections.counts.total(), 0);
  ASSERT_TRUE(report.verification);
  EXPECT_EQ(report.verification->passed.frame, 1);
  EXPECT_GT(report.verification->passed.count, 100);
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["verification"]["passed"]["count"], report.verification->passed.count);
  EXPECT_TRUE(json["verification"]["swallowed"]["frame"].is_null());
  const RunReport unseen =
      run_scene(flying_through(), "through.json", {.folder = place / "unseen"});
  EXPECT_FALSE(unseen.verification);
}

TEST(Run, BlockedShareIsOfAllPoints) {
  RunReport report;
  report.particles = 200;
  report.history.resize(3);
  report.history[1].stopped = 50;
  report.mass = 1;
  EXPECT_EQ(nlohmann::json::parse(to_json(report))["blocked_share"], 0.25);
  EXPECT_NE(frames_csv_line(2, report.history[1], 200).find(",50,0,0.25,"), std::string::npos);
}

TEST(Run, BodiesAsFastAsShotsPushClothAndDoNotPassIt) {
  Scene scene = hit_sheet(120);
  scene.frames = 6;
  scene.cloths[0].size = 17;
  const test::TemporaryFolder place;
  const RunReport report = run_scene(scene, "hit.json", {.folder = place / "run", .verify = true});
  EXPECT_EQ(report.intersections.counts.total(), 0);
  ASSERT_TRUE(report.verification);
  EXPECT_TRUE(report.verification->good());
  for (const FrameReport& frame : report.history) EXPECT_EQ(frame.whole_fell_back, 0);
  EXPECT_GT(report.centre_of_mass.back().z, 0.05);
}

TEST(Run, BodiesThatAreTooFastAreToldAndStopTheRunAtTheCloth) {
  Scene scene = hit_sheet(3000);
  scene.bodies[0].motion.back() = {0.053, {}, {0, 0, 9}};
  Simulation simulation(scene, "hit.json", 1);
  ASSERT_EQ(simulation.notes().size(), 1);
  EXPECT_EQ(simulation.notes()[0],
            "bodies go up to 3000 m/s, faster than cloth can be kept from them; 11 substeps or "
            "more are wanted");
  for (int frame = 1; frame <= 3; ++frame) simulation.advance();
  try {
    simulation.advance();
    ADD_FAILURE() << "went on";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("bodies pass cloth at up to 3000 m/s in frame 4"),
              std::string::npos)
        << error.what();
  }
}

TEST(Run, EndsAtRestWhereThatIsWanted) {
  Scene scene = ring(90);
  scene.bodies.clear();
  scene.cloths[0].surface = "builtin:sheet";
  scene.cloths[0].placement.translate = {0, 0.01, 0};
  const test::TemporaryFolder place;
  RunOptions options{.folder = place / "run"};
  options.until_rest = true;
  const RunReport report = run_scene(scene, "sheet.json", options);
  ASSERT_LT(report.frames, 90);
  EXPECT_EQ(report.notes.back(), "at rest in frame " + std::to_string(report.frames));
  EXPECT_EQ(value_at<std::int32_t>(read_file(place / "run" / "ring.pc2"), 28), report.frames + 1);
  options.resume = true;
  const RunReport again = run_scene(scene, "sheet.json", options);
  EXPECT_EQ(again.frames, report.frames);
  EXPECT_EQ(again.state_hash, report.state_hash);
  options.resume = options.until_rest = false;
  EXPECT_EQ(run_scene(scene, "sheet.json", options).frames, 90);
}

TEST(Run, InterruptedRunKeepsItsFrames) {
  const test::TemporaryFolder place;
  const fs::path folder = place / "run";
  const Scene scene = ring(10);
  Stopper stopper(2 * scene.substeps + 1);  // within the third frame
  EXPECT_THROW(run_scene(scene, "ring.json", {.folder = folder, .progress = &stopper}),
               Interrupted);
  const std::string cache = read_file(folder / "ring.pc2");
  EXPECT_EQ(value_at<std::int32_t>(cache, 28), 3);
  EXPECT_EQ(cache.size(), 32 + 3 * 256 * 12);
  EXPECT_EQ(open_run_folder(folder).frames, 3);
  for (const auto& entry : fs::directory_iterator(folder))
    EXPECT_EQ(entry.path().filename().string().find(".part"), std::string::npos) << entry.path();
}

TEST(Run, CsvHasOneLineAFrameUnderItsHeader) {
  const test::TemporaryFolder place;
  const fs::path folder = place / "run";
  run_scene(ring(3), "ring.json", {.folder = folder});
  const std::string csv = read_file(folder / "frames.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  const auto commas = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  const std::size_t end = csv.find('\n');
  EXPECT_EQ(commas(csv.substr(0, end)), commas(csv.substr(end + 1, csv.find('\n', end + 1) - end)));
}

TEST(Run, CutCacheIsRefused) {
  const test::TemporaryFolder place;
  const fs::path folder = place / "run";
  run_scene(ring(1), "ring.json", {.folder = folder});
  fs::resize_file(folder / "ring.pc2", 1000);
  EXPECT_THROW(open_run_folder(folder), InputError);
  EXPECT_THROW(open_run_folder(folder / "nowhere"), InputError);
}

TEST(Run, UnknownExportIsRefused) {
  const test::TemporaryFolder place;
  EXPECT_THROW(run_scene(ring(1), "ring.json", {.folder = place / "run", .exports = {"fbx"}}),
               UsageError);
}

TEST(Report, JsonHoldsTheContractsFields) {
  RunReport report;
  report.frames = 3;
  report.integrator = "implicit";
  report.state_hash = "0123456789abcdef";
  for (const double ms : {1.0, 9.0, 2.0}) {
    FrameReport frame;
    frame.milliseconds = ms;
    frame.residual = ms / 1000;
    report.history.push_back(frame);
  }
  report.centre_of_mass = {{1, 2, 3}};
  const auto json = parse_json(to_json(report), 9);
  for (const char* key : {"frames", "particles", "integrator", "threads", "time_step", "substeps",
                          "ms_per_frame", "strain", "residual", "contacts_max", "self_contacts_max",
                          "intersections", "centre_of_mass", "state_hash", "outputs"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["ms_per_frame"]["median"], 2);
  EXPECT_EQ(json["ms_per_frame"]["p95"], 9);
  EXPECT_EQ(json["residual"]["max"], 0.009);
  EXPECT_EQ(json["centre_of_mass"][0], nlohmann::json({1.0, 2.0, 3.0}));
}

}  // namespace
}  // namespace weft
