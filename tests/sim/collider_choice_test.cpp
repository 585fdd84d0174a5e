#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/collide/intersections.h"
#include "weft/geometry_image.h"
#include "weft/simulation.h"

namespace weft {
namespace {

Scene sheet_on_sphere(const ColliderOptions& collider) {
  Scene scene;
  scene.collider = collider;
  SceneCloth cloth;
  cloth.name = "sheet";
  cloth.surface = "builtin:sheet";
  cloth.size = 33;
  cloth.material = weft::testing::soft_fabric;
  cloth.placement.translate = {0, 0.53, 0};
  scene.cloths = {cloth};
  SceneBody body;
  body.name = "ball";
  body.surface = "builtin:sphere";
  body.size = 33;
  scene.bodies = {body};
  scene.ground = -0.5;
  return scene;
}

class Guarding : public ::testing::TestWithParam<const char*> {};

TEST_P(Guarding, DrapesWithoutIntersectionsAndWithTheSameBitsOnEveryTeam) {
  std::string hash;
  for (const int threads : {1, 2, 3, 7}) {
    Simulation simulation(sheet_on_sphere(*Colliders::find(GetParam())), "s.json", threads);
    const std::vector<Triangle> cloth = grid_triangles(simulation.cloths()[0].image),
                                body = grid_triangles(simulation.bodies()[0].image);
    const GridTriangles moving{&simulation.cloths()[0].state.position, &cloth};
    const GridTriangles still{&simulation.bodies()[0].positions, &body};
    IntersectionCheck check(std::span(&moving, 1), std::span(&still, 1), -0.5);
    int contacts = 0;
    for (int frame = 0; frame < 12; ++frame) {
      contacts = std::max(contacts, simulation.advance().contacts);
      EXPECT_EQ(check.count().total(), 0) << frame;
    }
    EXPECT_GT(contacts, 50);
    if (hash.empty()) hash = simulation.state_hash();
    EXPECT_EQ(simulation.state_hash(), hash) << threads << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Guarding,
                         ::testing::Values("pyramid", "sphere_tree", "spatial_hash", "image_space"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace weft
