#include <cmath>

#include <gtest/gtest.h>

#include "tests/view/golden.h"
#include "tests/view/shapes.h"
#include "weft/drawing.h"
#include "weft/error.h"
#include "weft/shapes.h"
#include "weft/view/normals.h"

namespace weft {
namespace {

constexpr int width = 160, height = 120;
constexpr Vec3f plaster{0.62F, 0.60F, 0.57F};

Vec3d mean_colour(const Picture& picture, int x0, int y0, int size) {
  Vec3d sum;
  for (int y = y0; y < y0 + size; ++y)
    for (int x = x0; x < x0 + size; ++x) {
      const std::size_t i = std::size_t{3} * (static_cast<std::size_t>(y) * picture.width + x);
      sum += Vec3d{1.0 * picture.rgb[i], 1.0 * picture.rgb[i + 1], 1.0 * picture.rgb[i + 2]};
    }
  return (1.0 / (size * size)) * sum;
}

DrawnSurface body_of(const Planes3& grid) {
  DrawnSurface body;
  body.positions = &grid;
  body.look = Look::body;
  body.colour = plaster;
  return body;
}

TEST(Renderer, SphereOverGroundLooksAsItDid) {
  const Planes3 sphere = sphere_grid(65, {0, 0.5F, 0}, 0.5F);
  const BorderMates seam(65, {{64, 0, 64}});
  DrawnScene scene;
  scene.surfaces.push_back(body_of(sphere));
  scene.surfaces[0].mates = &seam;
  scene.ground = 0.0;
  scene.camera = frame_box({{-0.8, 0, -0.8}, {0.8, 1, 0.8}}, 0.4, 0.35, 4.0 / 3);
  expect_golden("sphere", Renderer(width, height).draw(scene));
}

TEST(Renderer, WavySheetOfFabricLooksAsItDid) {
  const Planes3 sheet = wavy_sheet(65, 0.4F);
  DrawnSurface fabric;
  fabric.positions = &sheet;
  fabric.threads = 24;
  DrawnScene scene;
  scene.surfaces.push_back(fabric);
  scene.ground = 0.0;
  scene.camera = frame_box(bounds(sheet), 0.5, 0.5, 4.0 / 3);
  expect_golden("sheet", Renderer(width, height).draw(scene));
}

/// A floor below one diagonal of a folded quad and above the other.
TEST(Renderer, QuadsAreSplitAsTheyAreToldToBe) {
  Planes3 ridge(2);  // along the rising diagonal it is a roof, along the falling one a gutter
  ridge.set(0, 0, {-1, 1, -1});
  ridge.set(0, 1, {1, 0, -1});
  ridge.set(1, 0, {-1, 0, 1});
  ridge.set(1, 1, {1, 1, 1});
  Planes3 floor(2);
  for (int k = 0; k < 4; ++k) floor.set(k, {ridge.at(k).x, 0.5F, ridge.at(k).z});
  const auto drawn = [&](const std::vector<char>* rising) {
    DrawnSurface cloth;
    cloth.positions = &ridge;
    cloth.colour = {0, 0, 1};
    cloth.threads = 0;
    cloth.rising = rising;
    DrawnScene scene;
    scene.surfaces = {cloth, body_of(floor)};
    scene.camera = frame_box({{-1, 0, -1}, {1, 1, 1}}, 0, 1.5, 4.0 / 3);
    return Renderer(width, height).draw(scene);
  };
  const std::vector<char> roof{1}, gutter{0};
  EXPECT_EQ(drawn(&roof).rgb, drawn(nullptr).rgb) << "the first quad rises";
  EXPECT_NE(drawn(&roof).rgb, drawn(&gutter).rgb);
}

TEST(Renderer, ShadowsOfClothOnABodyAndOnTheGroundLookAsTheyDid) {
  const Planes3 sheet = wavy_sheet(65, 1.1F);
  const Planes3 ball = sphere_grid(33, {0.3F, 0.45F, 0}, 0.45F);
  const BorderMates seam(33, {{32, 0, 32}});
  DrawnSurface fabric;
  fabric.positions = &sheet;
  fabric.threads = 0;
  DrawnScene scene;
  scene.surfaces = {fabric, body_of(ball)};
  scene.surfaces[1].mates = &seam;
  scene.ground = 0.0;
  scene.camera = frame_box({{-1, 0, -1}, {1.4, 1.3, 1}}, 0.3, 0.12, 4.0 / 3);
  expect_golden("shadows", Renderer(width, height).draw(scene));
}

TEST(Renderer, BetweenTheChartsOfASurfaceThereIsNothing) {
  // Two upright squares, seen from the front, 1 m apart.
  const BorderMates charts(17, {{"left", 0, 0, 9, 8}, {"right", 0, 9, 9, 8}}, {});
  Planes3 grid(17);
  for (int s = 0; s < 17 * 17; ++s) {
    const int point = charts.representative(s), row = point / 17, col = point % 17;
    const float left =
        col < 9 ? -1.5F + static_cast<float>(col) / 7 : 0.5F + static_cast<float>(col - 9) / 7;
    grid.set(s, {left, static_cast<float>(row) / 8, 0});
  }
  DrawnScene scene;
  const Camera camera = frame_box({{-1.5, 0, 0}, {1.5, 1, 0}}, 0, 0, 4.0 / 3);
  scene.camera = camera;
  const Picture empty = Renderer(width, height).draw(scene);
  scene.surfaces.push_back(body_of(grid));
  scene.surfaces[0].mates = &charts;
  const Picture drawn = Renderer(width, height).draw(scene);
  const auto differs_at = [&](int x) {
    return length(mean_colour(drawn, x, height / 2, 4) - mean_colour(empty, x, height / 2, 4)) > 5;
  };
  EXPECT_FALSE(differs_at(width / 2 - 2));
  EXPECT_TRUE(differs_at(width / 4));
  EXPECT_TRUE(differs_at(3 * width / 4));
}

TEST(Renderer, AWeaveTooFineToBeSeenIsLeftOut) {
  const Planes3 sheet = wavy_sheet(65, 0.4F);
  DrawnSurface fabric;
  fabric.positions = &sheet;
  DrawnScene scene;
  scene.surfaces.push_back(fabric);
  scene.camera = frame_box(bounds(sheet), 0.5, 0.5, 4.0 / 3);
  Renderer renderer(width, height);
  const auto drawn_with = [&](float threads) {
    scene.surfaces[0].threads = threads;
    return renderer.draw(scene).rgb;
  };
  EXPECT_EQ(drawn_with(300), drawn_with(0));
  EXPECT_NE(drawn_with(12), drawn_with(0));
}

TEST(Renderer, MeshWithMarkedEdgesLooksAsItDid) {
  const TriangleMesh cube = cube_mesh();
  DrawnMesh mesh;
  mesh.mesh = &cube;
  mesh.marked_edges = {{2, 3}, {3, 7}, {7, 6}, {6, 2}};
  DrawnScene scene;
  scene.meshes.push_back(mesh);
  scene.ground = -0.5;
  scene.camera = frame_box(box_of(cube), 0.5, 0.5, 4.0 / 3);
  expect_golden("cube", Renderer(width, height).draw(scene));
}

TEST(Renderer, ShadowFallsOnTheSideAwayFromTheLight) {
  const Planes3 sphere = sphere_grid(33, {0, 0.3F, 0}, 0.3F);
  DrawnScene scene;
  scene.surfaces.push_back(body_of(sphere));
  scene.ground = 0.0;
  scene.light = {-1.57, 0.7};  // from the left of a camera that looks from +z
  scene.camera = frame_box({{-1, 0, -0.4}, {1, 0.6, 0.4}}, 0, 0.5, 4.0 / 3);
  const Picture picture = Renderer(width, height).draw(scene);
  const double left = mean_colour(picture, 34, 66, 6).y;
  const double right = mean_colour(picture, 110, 66, 6).y;
  EXPECT_LT(right, 0.8 * left);
}

TEST(Renderer, DrawingTheSameSceneTwiceGivesTheSameBytes) {
  const Planes3 sheet = wavy_sheet(33, 0.4F);
  const Planes3 other = sphere_grid(17, {0, 0.5F, 0}, 0.2F);
  DrawnScene scene;
  scene.surfaces = {body_of(sheet), body_of(other)};
  scene.ground = 0.0;
  scene.camera = frame_box(bounds(sheet), 0.5, 0.5, 4.0 / 3);
  Renderer renderer(width, height);
  const Picture first = renderer.draw(scene);
  DrawnScene fewer = scene;
  fewer.surfaces.pop_back();
  const Picture between = renderer.draw(fewer);
  EXPECT_NE(between.rgb, first.rgb);
  EXPECT_EQ(renderer.draw(scene).rgb, first.rgb);
  EXPECT_EQ(Renderer(width, height).draw(scene).rgb, first.rgb);
}

TEST(Renderer, ASurfaceOfTheSameRevisionIsNotLookedAtAgain) {
  const Planes3 sheet = wavy_sheet(33, 0.4F), other = wavy_sheet(33, 0.1F);
  DrawnScene scene;
  scene.surfaces = {body_of(sheet)};
  scene.ground = 0.0;
  scene.camera = frame_box(bounds(sheet), 0.5, 0.5, 4.0 / 3);
  scene.surfaces[0].revision = 7;
  Renderer renderer(width, height);
  const Picture first = renderer.draw(scene);
  scene.surfaces[0].positions = &other;
  EXPECT_EQ(renderer.draw(scene).rgb, first.rgb);
  scene.surfaces[0].revision = 8;
  const Picture moved = renderer.draw(scene);
  EXPECT_NE(moved.rgb, first.rgb);
  scene.surfaces[0].revision = 0;
  EXPECT_EQ(Renderer(width, height).draw(scene).rgb, moved.rgb);
}

TEST(Renderer, AMeshOfTheSameRevisionIsNotLookedAtAgain) {
  TriangleMesh mesh = make_shape("sphere");
  DrawnMesh drawn;
  drawn.mesh = &mesh;
  drawn.revision = 1;
  DrawnScene scene;
  scene.meshes.push_back(drawn);
  scene.ground = -1.0;
  scene.camera = frame_box({{-1, -1, -1}, {1, 1, 1}}, 0.4, 0.35, 4.0 / 3);
  Renderer renderer(width, height);
  const Picture before = renderer.draw(scene);
  for (Vec3d& p : mesh.positions) p = {p.x, 0.4 * p.y, p.z};
  EXPECT_EQ(renderer.draw(scene).rgb, before.rgb);
  scene.meshes[0].revision = 2;
  const Picture flat = renderer.draw(scene);
  EXPECT_NE(flat.rgb, before.rgb);
  EXPECT_EQ(Renderer(width, height).draw(scene).rgb, flat.rgb) << "its shadow is new, too";
}

TEST(Renderer, KeptLightIsThatOfThePictureBeforeUntilItIsAskedForAnew) {
  const Planes3 low = wavy_sheet(33, 0.1F), high = wavy_sheet(33, 0.8F);
  DrawnScene scene;
  scene.surfaces = {body_of(low)};
  scene.ground = 0.0;
  scene.camera = frame_box({{-1, 0, -1}, {1, 1, 1}}, 0.5, 0.5, 4.0 / 3);
  Renderer renderer(width, height);
  scene.keep_light = true;  // but there is none yet
  const Picture first = renderer.draw(scene);
  EXPECT_EQ(Renderer(width, height).draw(scene).rgb, first.rgb);
  scene.surfaces[0].positions = &high;
  const Picture kept = renderer.draw(scene);
  scene.keep_light = false;
  const Picture renewed = renderer.draw(scene);
  EXPECT_NE(kept.rgb, first.rgb);
  EXPECT_NE(kept.rgb, renewed.rgb);
  EXPECT_EQ(Renderer(width, height).draw(scene).rgb, renewed.rgb);
}

TEST(Renderer, ColoursOfSamplesAreTimesTheSurfacesOwn) {
  const Planes3 sheet = wavy_sheet(33, 0.4F);
  Planes3 halves(2);
  for (int r = 0; r < 2; ++r) {
    halves.set(r, 0, {1, 0, 0});
    halves.set(r, 1, {0, 0, 1});
  }
  DrawnScene scene;
  scene.surfaces = {body_of(sheet)};
  scene.surfaces[0].colour = {0.8F, 0.8F, 0.8F};
  scene.surfaces[0].colours = &halves;
  scene.camera = frame_box(bounds(sheet), 0, 0.9, 4.0 / 3);
  const Picture picture = Renderer(width, height).draw(scene);
  const Vec3d left = mean_colour(picture, 40, 60, 4);
  const Vec3d right = mean_colour(picture, 120, 60, 4);
  EXPECT_GT(left.x, left.z + 20);
  EXPECT_GT(right.z, right.x + 20);
}

TEST(Renderer, TwoRenderersTakeTurnsAndOneMayGo) {
  const Planes3 sphere = sphere_grid(17, {0, 0, 0}, 0.5F);
  DrawnScene scene;
  scene.surfaces.push_back(body_of(sphere));
  scene.camera = frame_box(bounds(sphere), 0, 0, 1);
  Renderer one(32, 32);
  const Picture before = one.draw(scene);
  {
    Renderer two(16, 48);
    EXPECT_EQ(two.draw(scene).height, 48);
    EXPECT_EQ(one.draw(scene).rgb, before.rgb);
  }
  EXPECT_EQ(one.draw(scene).rgb, before.rgb);
}

TEST(Renderer, SamplesThatAreNotFiniteAreDrawnAtTheSampleBefore) {
  Planes3 holed = sphere_grid(33, {0, 0, 0}, 0.5F);
  Planes3 filled = holed;
  holed.set(10, 12, {NAN, HUGE_VALF, 0});
  filled.set(10, 12, filled.at(10, 11));
  DrawnScene scene;
  scene.surfaces.push_back(body_of(holed));
  scene.camera = frame_box(bounds(holed), 0.3, 0.2, 4.0 / 3);
  Renderer renderer(width, height);
  const Picture picture = renderer.draw(scene);
  scene.surfaces[0].positions = &filled;
  EXPECT_EQ(renderer.draw(scene).rgb, picture.rgb);
}

TEST(Renderer, NothingFiniteAtAllStillGivesAPicture) {
  Planes3 grid(5);
  for (int s = 0; s < 25; ++s) grid.set(s, {NAN, NAN, NAN});
  TriangleMesh mesh{{{NAN, 0, 0}, {1e300, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 9}}};
  DrawnMesh drawn;
  drawn.mesh = &mesh;
  drawn.marked_edges = {{0, 1}, {1, 99}};
  DrawnScene scene;
  scene.surfaces.push_back(body_of(grid));
  scene.meshes.push_back(drawn);
  scene.ground = 0.0;
  scene.camera = frame_box(bounds(grid), 0, 0.3, 4.0 / 3);
  const Picture picture = Renderer(width, height).draw(scene);
  EXPECT_GT(mean_colour(picture, 0, 0, 8).x, 20);
}

TEST(Renderer, APictureWithoutPixelsIsRefused) {
  EXPECT_THROW(Renderer(0, 10), Error);
  EXPECT_THROW(Renderer(10, 100000), Error);
}

TEST(Normals, OfASphereAreItsDirections) {
  const int n = 65;
  const Planes3 normals = grid_normals(sphere_grid(n, {0, 0, 0}, 2), nullptr);
  for (int r = 1; r + 1 < n; ++r)
    for (int c = 1; c + 1 < n; ++c) {
      const double v = pi * r / (n - 1);
      const double u = 2 * pi * c / (n - 1);
      const Vec3d wanted{sine(v) * sine(u), -cosine(v), sine(v) * cosine(u)};
      ASSERT_NEAR(length(vec_cast<double>(normals.at(r, c)) - wanted), 0, 0.02);
    }
}

TEST(Normals, AreEqualAcrossASeam) {
  const int n = 33;
  // The first and the last column of the sphere are one curve: border positions of column n - 1 run
  // up from n - 1, those of column 0 down from 4 (n - 1).
  const BorderMates mates(n, {{n - 1, 0, n - 1}});
  const Planes3 normals = grid_normals(sphere_grid(n, {0, 0, 0}, 1), &mates);
  const Planes3 apart = grid_normals(sphere_grid(n, {0, 0, 0}, 1), nullptr);
  for (int r = n / 4; r < 3 * n / 4; ++r) {
    ASSERT_EQ(normals.at(r, 0), normals.at(r, n - 1));
    const double v = pi * r / (n - 1);
    const Vec3d wanted{0, -cosine(v), sine(v)};
    ASSERT_NEAR(length(vec_cast<double>(normals.at(r, 0)) - wanted), 0, 0.01);
    ASSERT_GT(length(vec_cast<double>(apart.at(r, 0)) - wanted), 0.02);
  }
}

TEST(Normals, OfACubeAreItsFacesAndItsOwnVerticesComeFirst) {
  const TriangleMesh cube = cube_mesh();
  const ShadedMesh shaded = shade_mesh(cube);
  EXPECT_EQ(shaded.positions.size(), 24U);
  for (std::size_t v = 0; v < cube.positions.size(); ++v)
    EXPECT_EQ(shaded.positions[v], vec_cast<float>(cube.positions[v]));
  for (std::size_t t = 0; t < cube.triangles.size(); ++t) {
    const Vec3d a = cube.positions[cube.triangles[t][0]];
    const Vec3d face = normalized(
        cross(cube.positions[cube.triangles[t][1]] - a, cube.positions[cube.triangles[t][2]] - a));
    for (int k = 0; k < 3; ++k) {
      const int corner = shaded.triangles[t][k];
      EXPECT_EQ(shaded.positions[corner], vec_cast<float>(cube.positions[cube.triangles[t][k]]));
      EXPECT_NEAR(dot(vec_cast<double>(shaded.normals[corner]), face), 1, 1e-6);
    }
  }
}

TEST(Normals, OfARoundMeshAreSmoothAndNoVertexIsCopied) {
  const Planes3 grid = sphere_grid(33, {0, 0, 0}, 1);
  TriangleMesh band;  // the sphere without its poles and its seam
  for (int r = 4; r < 29; ++r)
    for (int c = 0; c < 32; ++c) band.positions.push_back(vec_cast<double>(grid.at(r, c)));
  for (int r = 0; r < 24; ++r)
    for (int c = 0; c < 32; ++c) {
      const int a = r * 32 + c, b = r * 32 + (c + 1) % 32;
      band.triangles.push_back({a, b, b + 32});
      band.triangles.push_back({a, b + 32, a + 32});
    }
  const ShadedMesh shaded = shade_mesh(band);
  ASSERT_EQ(shaded.positions.size(), band.positions.size());
  for (std::size_t v = 32; v + 32 < shaded.positions.size(); ++v)
    EXPECT_GT(dot(shaded.normals[v], shaded.positions[v]), 0.995F);
}

}  // namespace
}  // namespace weft
