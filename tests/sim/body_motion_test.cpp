#include "weft/sim/motion/body_motion.h"

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"
#include "weft/error.h"
#include "weft/image/builtin.h"
#include "weft/mesh.h"
#include "weft/run/export/point_cache_writers.h"
#include "weft/shapes.h"

namespace weft {
namespace {

constexpr int samples = 17;
constexpr double frame_rate = 10;  // [1/s]

LoadedSurface ring_surface() { return {make_image_shape("torus", samples), {}, {}, {}, {}}; }

SceneBody moved(std::vector<MotionKey> motion) {
  SceneBody body;
  body.surface = "builtin:torus";
  body.placement = {{2, 2, 2}, {0, 90, 0}, {1, 2, 3}};
  body.motion = std::move(motion);
  return body;
}

/// By a motion that has placed nothing yet.
Planes3 place_at(BodyMotion motion, double seconds, int n = samples) {
  Planes3 places(n);
  ThreadTeam team(2);
  motion.place(seconds, places, team);
  return places;
}

void expect_near(Vec3f a, Vec3d b, double tolerance = 1e-6) {
  EXPECT_LT(length(vec_cast<double>(a) - b), tolerance);
}

TEST(BodyMotion, TurnsAboutThePlacedOriginAndMoves) {
  const SceneBody body = moved({{0, {}, {}}, {2, {0, 180, 0}, {0, 1, 0}}});
  const LoadedSurface surface = ring_surface();
  const BodyMotion motion(body, surface, {frame_rate, {}});
  EXPECT_TRUE(motion.moves());
  const Planes3 rest = placed_positions(surface.image, placement_map(body.placement));
  const Planes3 half = place_at(motion, 1), end = place_at(motion, 7);
  for (const int s : {0, 40, 100}) {
    const Vec3d arm = vec_cast<double>(rest.at(s)) - Vec3d{1, 2, 3};
    expect_near(half.at(s), Vec3d{1 + arm.z, 2.5 + arm.y, 3 - arm.x});
    expect_near(end.at(s), Vec3d{1 - arm.x, 3 + arm.y, 3 - arm.z});
  }
}

TEST(BodyMotion, LeadInGoesFromRestToTheBeginningAndDelaysIt) {
  SceneBody body = moved({{0, {}, {0, 4, 0}}, {1, {}, {0, 5, 0}}});
  body.lead_in = 2;
  const LoadedSurface surface = ring_surface();
  const BodyMotion motion(body, surface, {frame_rate, {}});
  const auto risen = [&](double seconds) {
    const Planes3 rest = placed_positions(surface.image, placement_map(body.placement));
    return place_at(motion, seconds).at(3).y - rest.at(3).y;
  };
  EXPECT_EQ(risen(0), 0);
  EXPECT_NEAR(risen(0.02), 0, 2e-3);
  EXPECT_NEAR(risen(1), 2, 1e-6);
  EXPECT_NEAR(risen(2), 4, 1e-6);
  EXPECT_NEAR(risen(2.5), 4.5, 1e-6);
  EXPECT_NEAR(risen(9), 5, 1e-6);
}

TEST(BodyMotion, WaitsBeforeTheLeadIn) {
  SceneBody body = moved({{0, {}, {0, 4, 0}}, {1, {}, {0, 5, 0}}});
  const LoadedSurface surface = ring_surface();
  body.lead_in = 2;
  const BodyMotion at_once(body, surface, {frame_rate, {}});
  body.wait = 1.5;
  const BodyMotion waits(body, surface, {frame_rate, {}});
  for (const double seconds : {0.0, 0.5, 2.0, 2.5, 9.0})
    EXPECT_EQ(place_at(waits, seconds + 1.5).at(3).y, place_at(at_once, seconds).at(3).y);
  EXPECT_EQ(place_at(waits, 1.4).at(3).y, place_at(waits, 0).at(3).y);
}

TEST(BodyMotion, FastestBoundsEverySpeed) {
  SceneBody body = moved({{0, {}, {0, 1, 0}}, {1, {0, 90, 20}, {1, 0, 2}}, {3, {}, {}}});
  body.lead_in = 0.5;
  const BodyMotion motion(body, ring_surface(), {frame_rate, {}});
  constexpr double step = 0.01;
  double fastest = 0;
  for (double seconds = 0; seconds < 4; seconds += step) {
    const Planes3 a = place_at(motion, seconds), b = place_at(motion, seconds + step);
    for (int s = 0; s < samples * samples; ++s)
      fastest = std::max(fastest, double{length(b.at(s) - a.at(s))} / step);
  }
  EXPECT_LE(fastest, motion.fastest() * (1 + 1e-4));
  EXPECT_GE(fastest, 0.5 * motion.fastest());
}

TEST(BodyMotion, AnimationCarriesTheSamplesOfAMesh) {
  const test::TemporaryFolder folder;
  const TriangleMesh box = make_shape("box");
  write_mesh(folder / "box.obj", box);
  // Every vertex goes linearly, so samples must do the same between them.
  const auto sheared = [](Vec3f p, float by) { return Vec3f{p.x + by * p.y, p.y + by, p.z}; };
  Pc2Writer writer(folder / "box.pc2", static_cast<int>(box.positions.size()));
  for (const float by : {0.0F, 1.0F, 3.0F}) {
    std::vector<Vec3f> points;
    for (const Vec3d p : box.positions) points.push_back(sheared(vec_cast<float>(p), by));
    writer.add(points);
  }
  writer.finish();
  SceneBody body;
  body.surface = (folder / "box.obj").string();
  body.animation = (folder / "box.pc2").string();
  ConvertOptions options;
  options.size = 33;
  options.keep_places = true;
  const LoadedSurface surface = load_surface(body.surface, options);
  const BodyMotion motion(body, surface, {frame_rate, {}});
  const Planes3 rest = placed_positions(surface.image, placement_map(body.placement));
  for (const auto& [seconds, by] : {std::pair{0.0, 0.0F}, {0.1, 1.0F}, {0.15, 2.0F}, {9.0, 3.0F}}) {
    const Planes3 there = place_at(motion, seconds, 33);
    for (int s = 0; s < 33 * 33; ++s)
      expect_near(there.at(s), vec_cast<double>(sheared(rest.at(s), by)), 1e-5);
    for (int i = 0; i < surface.image.mates.class_count(); ++i)
      for (const int mate : surface.image.mates.mates(i))
        EXPECT_EQ(there.at(mate), there.at(surface.image.mates.mates(i)[0]));
  }
  EXPECT_NEAR(motion.fastest(), 20 * std::sqrt(1 + 0.2 * 0.2), 1e-3);
  // What was placed before makes no difference.
  BodyMotion used = motion;
  Planes3 there(33);
  ThreadTeam team(2);
  for (const double seconds : {0.15, 0.02, 0.1, 0.13, 9.0, 0.04}) {
    used.place(seconds, there, team);
    const Planes3 fresh = place_at(motion, seconds, 33);
    for (int s = 0; s < 33 * 33; ++s) ASSERT_EQ(there.at(s), fresh.at(s)) << seconds;
  }
}

TEST(BodyMotion, AnimationOfAnImageHasItsSamplesOrItsVertices) {
  const test::TemporaryFolder folder;
  SceneBody body = moved({});
  body.animation = (folder / "ring.pc2").string();
  const LoadedSurface surface = ring_surface();
  const auto write = [&](int points) {
    Pc2Writer writer(folder / "ring.pc2", points);
    writer.add(std::vector<Vec3f>(static_cast<std::size_t>(points), {1, 0, 0}));
    writer.finish();
  };
  for (const int points : {samples * samples, 16 * 16}) {
    write(points);
    // Placed as the surface is: twice as large, turned by 90 degrees, moved.
    expect_near(place_at(BodyMotion(body, surface, {frame_rate, {}}), 0).at(9), {1, 2, 1});
  }
  write(100);
  EXPECT_EQ(test::message_of<SceneError>([&] {
              BodyMotion(body, surface, {frame_rate, {}});
            }),
            body.animation.name +
                ": 100 points; 289 (the samples of builtin:torus), or 256 (mates joined), are "
                "wanted");
}

TEST(BodyMotion, AnimationOfAMeshNeedsItsVertices) {
  const test::TemporaryFolder folder;
  SceneBody body;
  body.surface = "builtin:box";
  body.animation = (folder / "a.pc2").string();
  Pc2Writer writer(body.animation.name, 7);
  writer.add(std::vector<Vec3f>(7));
  writer.finish();
  ConvertOptions options;
  options.size = 33;
  options.keep_places = true;
  const LoadedSurface surface = load_surface(body.surface, options);
  EXPECT_EQ(test::message_of<SceneError>([&] {
              BodyMotion(body, surface, {frame_rate, {}});
            }),
            body.animation.name + ": 7 points; " +
                std::to_string(make_shape("box").positions.size()) +
                ", the vertices of builtin:box, are wanted");
}

}  // namespace
}  // namespace weft
