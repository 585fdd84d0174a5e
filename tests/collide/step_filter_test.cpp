#include "weft/collide/filter/step_filter.h"

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"

namespace weft::step_filter_test {
namespace {

using test::pyramid;
using test::TestCloth;

constexpr double time_step = 1.0 / 240;
constexpr int side = 9;

Obstacles floor_at(double height) {
  Obstacles obstacles;
  obstacles.ground = height;
  return obstacles;
}

/// A sheet above the ground, and the filter alone.
class OverGround {
 public:
  explicit OverGround(const std::function<Vec3d(int, int)>& at = [](int r, int c) {
    return Vec3d{0.1 * c, 0.01, 0.1 * r};
  }) {
    cloth_.place(at);
    const SurfaceGrid* grid = &world_.cloths[0].grid;
    untangler_.set_up(std::span(&grid, 1), std::span(&properties_, 1));
  }
  void move_all(Vec3f way) {
    for (int s = 0; s < side * side; ++s) {
      cloth_.position.set(s, cloth_.start.at(s) + way);
      cloth_.velocity.set(s, (1 / static_cast<float>(time_step)) * way);
    }
  }
  void move_on(int sample, Vec3f way) {
    cloth_.position.set(sample, cloth_.position.at(sample) + way);
  }
  FilterCounts run(StepFilter::Pass pass) {
    const MovingCloth moving = cloth_.moving();
    return filter.run(std::span(&moving, 1), time_step, pass, team_);
  }
  [[nodiscard]] Vec3f end(int sample) const { return cloth_.position.at(sample); }
  [[nodiscard]] Vec3f velocity(int sample) const { return cloth_.velocity.at(sample); }

 private:
  TestCloth cloth_{side};
  BorderMates none_;
  CollidingCloth properties_{.mates = none_,
                             .size = side,
                             .thickness = 0.004,
                             .rest_spacing = 0.1,
                             .self_collision = true,
                             .self_thickness = 0.004};
  ThreadTeam team_{1};
  CollisionWorld world_{pyramid, floor_at(0), std::span(&properties_, 1)};
  Untangler untangler_;

 public:
  StepFilter filter{world_, untangler_};
};

TEST(StepFilter, LeavesWhatMeetsNothing) {
  OverGround sheet;
  sheet.move_all({0.003F, -0.005F, 0});
  const Vec3f proposed = sheet.end(5);
  EXPECT_EQ(sheet.run(StepFilter::Pass::end).moved, 0);
  EXPECT_EQ(sheet.end(5), proposed);
  EXPECT_TRUE(sheet.filter.struck().empty());
}

TEST(StepFilter, HoldsEndsAboveTheGroundAndTakesTheirSpeedInto) {
  OverGround sheet;
  sheet.move_all({0.003F, -0.015F, 0});
  EXPECT_EQ(sheet.run(StepFilter::Pass::end).moved, side * side);
  EXPECT_EQ(sheet.filter.struck().size(), std::size_t{side} * side);
  for (int s = 0; s < side * side; ++s) {
    EXPECT_GE(sheet.end(s).y, 0);
    EXPECT_LT(sheet.end(s).y, 1e-4F);
    EXPECT_NEAR(sheet.velocity(s).y, 0, 1e-6);
    EXPECT_NEAR(sheet.velocity(s).x, 0.003 / time_step, 1e-5);  // along the ground it goes on
  }
}

TEST(StepFilter, LeavesVelocitiesOfGuesses) {
  OverGround sheet;
  sheet.move_all({0, -0.015F, 0});
  EXPECT_EQ(sheet.run(StepFilter::Pass::guess).moved, side * side);
  for (int s = 0; s < side * side; ++s) {
    EXPECT_GE(sheet.end(s).y, 0);
    EXPECT_NEAR(sheet.velocity(s).y, -0.015 / time_step, 1e-5);
  }
}

/// Corners thrown through the layer below them, in a sheet that falls.
TEST(StepFilter, TakesStoppedPointsAlongWithClothThatMovesAsAWhole) {
  OverGround folded([](int r, int c) {
    return c < 5 ? Vec3d{0.1 * c, 5, 0.1 * r} : Vec3d{0.1 * (8 - c) + 0.03, 5.02, 0.1 * r};
  });
  folded.move_all({0, -0.4F, 0});
  folded.move_on(4 * side + 7, {0, -0.3F, 0});
  EXPECT_GT(folded.run(StepFilter::Pass::end).stopped, 0);
  for (int s = 0; s < side * side; ++s) EXPECT_NEAR(folded.end(s).y, 5.01 - 0.4, 0.05);
}

/// Two balls that close on the middle of a sheet, and into each other.
TEST(StepFilter, LeavesTheRestWhereBodiesCloseOnCloth) {
  Obstacles closing;
  for (const double way : {1.0, -1.0})
    closing.bodies.push_back(test::octahedral_sphere(17, 0.1, {0.4, 0.104 * way, 0.4}));
  std::vector<Planes3> ends;
  for (const Body& ball : closing.bodies) ends.push_back(ball.positions);
  for (int s = 0; s < 17 * 17; ++s)
    for (const int k : {0, 1}) ends[k].set(s, ends[k].at(s) - Vec3f{0, k == 0 ? 0.01F : -0.01F, 0});
  const std::array<const Planes3*, 2> to{&ends[0], &ends[1]};
  const BorderMates none;
  const CollidingCloth properties{
      .mates = none, .size = side, .thickness = 0.004, .rest_spacing = 0.1};
  ThreadTeam team(1);
  CollisionWorld world(pyramid, closing, std::span(&properties, 1));
  Untangler untangler;
  const SurfaceGrid* grid = &world.cloths[0].grid;
  untangler.set_up(std::span(&grid, 1), std::span(&properties, 1));
  TestCloth cloth(side);
  cloth.place([](int r, int c) { return Vec3d{0.1 * c, 0, 0.1 * r}; });
  for (int s = 0; s < side * side; ++s)
    cloth.position.set(s, cloth.start.at(s) + Vec3f{0.001F, 0, 0});
  const MovingCloth moving = cloth.moving();
  world.move_bodies(to, team);
  world.place_bodies(team);
  StepFilter filter(world, untangler);
  const FilterCounts counts =
      filter.run(std::span(&moving, 1), time_step, StepFilter::Pass::end, team);
  EXPECT_GT(counts.stopped, 0) << "nothing was caught";
  EXPECT_EQ(counts.fell_back, 0);
  EXPECT_EQ(cloth.position.at(0), (Vec3f{0.001F, 0, 0}));
}

}  // namespace
}  // namespace weft::step_filter_test
