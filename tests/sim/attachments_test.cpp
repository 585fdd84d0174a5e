#include "weft/sim/motion/attachments.h"

#include <gtest/gtest.h>

#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/image/builtin.h"
#include "weft/sim/placement.h"

namespace weft {
namespace {

constexpr int size = 9;

/// A sheet of cloth a little above a torus, and the torus.
struct Tied {
  Tied()
      : body(make_image_shape("torus", 33)),
        places(world_positions(body)),
        cloth(make_cloth(placed_positions(make_image_shape("sheet", size),
                                          placement_map({{1, 1, 1}, {}, {0, 0.17, 0}})),
                         BorderMates(size, {}), {})) {
    surfaces = {{"ring", &places, grid_triangles(body)}};
  }
  std::vector<TiedPin> tie(std::vector<SceneAttachment> wanted) {
    return tie_places(cloth, wanted, surfaces, motions);
  }
  void move(const std::vector<TiedPin>& tied, const Planes3& to) {
    const Planes3* const body_places = &to;
    move_tied(tied, std::span(&body_places, 1), cloth);
  }
  GeometryImage body;
  Planes3 places;
  std::vector<TiedSurface> surfaces;
  std::vector<PinMotion> motions;
  Cloth cloth;
};

TEST(Attachments, WhereTheBodyStandsSamplesAreAtRest) {
  Tied scene;
  const auto tied = scene.tie({{"ring", RegionPin{{0, 0}, {1, 1}}}});
  ASSERT_EQ(tied.size(), size * size);
  scene.move(tied, scene.places);
  for (const Pin& pin : scene.cloth.pins)
    EXPECT_LT(length(pin.target - vec_cast<double>(scene.cloth.rest.at(pin.sample))), 1e-9);
}

TEST(Attachments, SamplesMoveAndTurnWithTheBody) {
  Tied scene;
  const auto tied = scene.tie({{"ring", RegionPin{{0, 0}, {1, 1}}}});
  const PlacementMap map = placement_map({{1, 1, 1}, {20, -130, 70}, {3, 2, 1}});
  scene.move(tied, placed_positions(scene.body, map));
  for (const Pin& pin : scene.cloth.pins)
    EXPECT_LT(length(pin.target - map.point(vec_cast<double>(scene.cloth.rest.at(pin.sample)))),
              1e-4);
}

TEST(Attachments, TheLastPlaceHoldsASample) {
  Tied scene;
  scene.motions =
      pin_places(scene.cloth, std::vector<ScenePin>{{ImagePin{{0, 0}}, {{0, {}, {9, 9, 9}}}},
                                                    {ImagePin{{1, 0}}, {{0, {}, {9, 9, 9}}}}});
  const auto tied = scene.tie({{"ring", ImagePin{{0, 0}}}, {"ring", RegionPin{{0, 0}, {0.5, 0}}}});
  EXPECT_EQ(tied.size(), 5);
  move_pins(scene.motions, 0, scene.cloth);
  scene.move(tied, scene.places);
  EXPECT_LT(length(scene.cloth.pins[0].target), 2);
  EXPECT_GT(length(scene.cloth.pins[1].target), 9);
}

TEST(Attachments, BodiesWithoutAreaHoldNothing) {
  Tied scene;
  scene.places = Planes3(scene.places.size());
  EXPECT_THROW(scene.tie({{"ring", ImagePin{{0, 0}}}}), SceneError);
  const Vec3d place{1, 2, 3};
  EXPECT_FALSE(tie_to_nearest(std::span(&place, 1), scene.surfaces).front());
  EXPECT_FALSE(tie_to_nearest(std::span(&place, 1), {}).front());
}

TEST(Attachments, UnknownBodiesAndEmptyRegionsAreRefused) {
  Tied scene;
  EXPECT_THROW(scene.tie({{"rong", ImagePin{{0, 0}}}}), SceneError);
  EXPECT_THROW(scene.tie({{"ring", RegionPin{{0.01, 0.01}, {0.02, 0.02}}}}), SceneError);
}

}  // namespace
}  // namespace weft
