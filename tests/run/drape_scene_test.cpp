#include "weft/drape_scene.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "weft/mesh.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

/// A box as a mesh file of a folder.
std::string box_file(const fs::path& path, Vec3d lower, Vec3d upper) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({(i & 1) != 0 ? upper.x : lower.x, (i & 2) != 0 ? upper.y : lower.y,
                              (i & 4) != 0 ? upper.z : lower.z});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  write_mesh(path, mesh);
  return path.string();
}

TEST(Drape, SheetIsLaidOverABodyOfOneMetre) {
  const test::TemporaryFolder folder;
  const Scene scene =
      make_drape_scene("builtin:sheet", box_file(folder / "b.obj", {1, -2, 0}, {2, 2, 2}), {});
  const Placement& body = scene.bodies.at(0).placement;
  EXPECT_DOUBLE_EQ(body.scale.x, 0.25);
  EXPECT_DOUBLE_EQ(body.translate.y, 0.5);
  EXPECT_EQ(scene.ground, 0.0);
  // The wider horizontal side is 2 * 0.25 = 0.5 m.
  const Placement& cloth = scene.cloths.at(0).placement;
  EXPECT_NEAR(cloth.scale.x, 0.8, 1e-12);
  EXPECT_NEAR(cloth.translate.x, 0.375, 1e-12);
  EXPECT_NEAR(cloth.translate.y, 1.02, 1e-12);
  EXPECT_NEAR(cloth.translate.z, 0.25, 1e-12);
}

TEST(Drape, ABodyFarFromTheOriginIsBroughtThere) {
  const test::TemporaryFolder folder;
  const auto placed = [&](Vec3d at) {
    const std::string body = box_file(folder / "box.obj", at, at + Vec3d{1, 1, 1});
    return make_drape_scene("builtin:sheet", body, {}).bodies[0].placement.translate;
  };
  EXPECT_EQ(placed({30000, -20000, 10000}), (Vec3d{-30000.5, 20000, -10000.5}));
  EXPECT_EQ(placed({50, 3, 0}), (Vec3d{0, -3, 0}));
}

TEST(Drape, AsIsKeepsTheBodysSize) {
  const test::TemporaryFolder folder;
  DrapeOptions options;
  options.as_is = true;
  const Scene scene =
      make_drape_scene("builtin:sheet", box_file(folder / "b.obj", {1, -2, 0}, {2, 2, 2}), options);
  EXPECT_EQ(scene.bodies.at(0).placement.scale.x, 1);
  EXPECT_NEAR(scene.cloths.at(0).placement.scale.x, 3.2, 1e-12);
  EXPECT_NEAR(scene.cloths.at(0).placement.translate.y, 4.02, 1e-12);
}

TEST(Drape, GarmentOnItsBodyStaysThere) {
  const test::TemporaryFolder folder;
  const std::string body = box_file(folder / "b.obj", {0, 0, 0}, {1, 3, 1});
  const Scene worn =
      make_drape_scene(box_file(folder / "worn.obj", {-0.05, 1, -0.05}, {1.05, 2, 1.05}), body, {});
  EXPECT_EQ(worn.bodies.at(0).placement.scale.x, 1);
  EXPECT_EQ(worn.cloths.at(0).placement.translate, (Vec3d{}));
  EXPECT_EQ(worn.cloths.at(0).placement.scale, (Vec3d{1, 1, 1}));
  const Scene apart =
      make_drape_scene(box_file(folder / "apart.obj", {0.8, 1, 0}, {2, 2, 1}), body, {});
  EXPECT_NEAR(apart.bodies.at(0).placement.scale.x, 1.0 / 3, 1e-12);
  EXPECT_NEAR(apart.cloths.at(0).placement.translate.y, 1.02 - 1, 1e-12);
}

TEST(Drape, ClothThatIsSunkInABodyIsLaidOnTop) {
  const test::TemporaryFolder folder;
  const std::string body = box_file(folder / "b.obj", {0, 0, 0}, {1, 3, 1}),
                    cloth = box_file(folder / "c.obj", {0.1, 1, 0.1}, {0.9, 2, 0.9});
  EXPECT_NEAR(make_drape_scene(cloth, body, {}).cloths.at(0).placement.translate.y, 1.02 - 1,
              1e-12);
  // About half of the points of a surface on itself are inside.
  EXPECT_GT(
      make_drape_scene("builtin:sphere", "builtin:sphere", {}).cloths.at(0).placement.translate.y,
      1);
}

TEST(Drape, RingIsLaidOnTopOfASphereOfItsSize) {
  const Scene scene = make_drape_scene("builtin:torus", "builtin:sphere", {});
  EXPECT_EQ(scene.cloths.at(0).placement.scale.x, 1);
  EXPECT_NEAR(scene.cloths.at(0).placement.translate.y, 1.02 + 0.15, 1e-3);
}

}  // namespace
}  // namespace weft
