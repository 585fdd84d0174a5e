#include "apps/viewer/orbit_camera.h"

#include <gtest/gtest.h>

#include "weft/view/gl/matrix.h"

namespace weft::viewer {
namespace {

constexpr int width = 800, height = 600;

OrbitCamera camera_on(const Box3d& box, int covered = 0) {
  OrbitCamera camera;
  camera.resize(width, height, covered);
  camera.frame(box);
  return camera;
}

const Box3d unit_box{{-0.5, 0, -0.5}, {0.5, 1, 0.5}};

/// Where the renderer puts a point. [pixels]
Vec2d drawn_at(const OrbitCamera& camera, Vec3d p) {
  const gl::Matrix m =
      gl::perspective(camera.camera(), static_cast<double>(width) / height, 0.01, 100);
  const auto row = [&](int r) { return m[r] * p.x + m[4 + r] * p.y + m[8 + r] * p.z + m[12 + r]; };
  return {0.5 * width * (1 + row(0) / row(3)), 0.5 * height * (1 - row(1) / row(3))};
}

TEST(OrbitCamera, PixelsAreThoseOfTheRenderer) {
  const OrbitCamera camera = camera_on(unit_box);
  for (const Vec3d p : {Vec3d{0, 0, 0}, Vec3d{0.4, 0.9, -0.3}, Vec3d{-0.5, 0.2, 0.5}}) {
    EXPECT_NEAR(camera.pixel_of(p).x, drawn_at(camera, p).x, 1e-2);
    EXPECT_NEAR(camera.pixel_of(p).y, drawn_at(camera, p).y, 1e-2);
  }
}

TEST(OrbitCamera, ARayGoesThroughWhatIsSeenThere) {
  const OrbitCamera camera = camera_on(unit_box);
  const Vec3d p{0.3, 0.7, 0.1};
  const Ray ray = camera.ray_through(camera.pixel_of(p));
  EXPECT_LT(length(cross(p - ray.from, ray.direction)), 1e-9);
  EXPECT_GT(dot(p - ray.from, ray.direction), 0);
}

TEST(OrbitCamera, FramingShowsTheWholeBoxBesideWhatIsCovered) {
  for (const int covered : {0, 300}) {
    const OrbitCamera camera = camera_on(unit_box, covered);
    for (int i = 0; i < 8; ++i) {
      const Vec2d at = camera.pixel_of({(i & 1) - 0.5, (i >> 1 & 1) * 1.0, (i >> 2 & 1) - 0.5});
      // A little of the covered part's width is lost to the view from aside.
      EXPECT_GT(at.x, covered - 0.05 * width);
      EXPECT_LT(at.x, width + 1);
      EXPECT_GT(at.y, -1);
      EXPECT_LT(at.y, height + 1);
    }
  }
}

TEST(OrbitCamera, OrbitingKeepsTheDistanceAndPanningTheDirection) {
  OrbitCamera camera = camera_on(unit_box);
  const Camera before = camera.camera();
  camera.orbit({120, 40});
  const Camera turned = camera.camera();
  EXPECT_NEAR(length(turned.eye - turned.target), length(before.eye - before.target), 1e-12);
  EXPECT_GT(length(turned.eye - before.eye), 0.5);
  camera.pan({50, -30});
  const Camera moved = camera.camera();
  EXPECT_LT(length((moved.eye - moved.target) - (turned.eye - turned.target)), 1e-12);
}

TEST(OrbitCamera, PanningTakesWhatIsLookedAtAlongWithTheMouse) {
  OrbitCamera camera = camera_on(unit_box);
  const Vec3d seen = camera.camera().target;
  const Vec2d before = camera.pixel_of(seen);
  camera.pan({60, 25});
  EXPECT_NEAR(camera.pixel_of(seen).x, before.x + 60, 1e-6);
  EXPECT_NEAR(camera.pixel_of(seen).y, before.y + 25, 1e-6);
}

TEST(OrbitCamera, ZoomingKeepsWhatIsUnderTheMouse) {
  OrbitCamera camera = camera_on(unit_box);
  const Vec2d mouse{500, 200};
  const Vec3d under = camera.on_facing_plane(mouse, camera.camera().target);
  const double before = length(camera.camera().eye - camera.camera().target);
  camera.zoom(2.5, mouse);
  EXPECT_LT(length(camera.camera().eye - camera.camera().target), 0.8 * before);
  EXPECT_NEAR(camera.pixel_of(under).x, mouse.x, 1e-6);
  EXPECT_NEAR(camera.pixel_of(under).y, mouse.y, 1e-6);
}

TEST(OrbitCamera, NeverTurnsOverTheTop) {
  OrbitCamera camera = camera_on(unit_box);
  camera.orbit({0, 1e5});
  EXPECT_GT(camera.camera().up.y, 0);
  camera.orbit({0, -1e6});
  EXPECT_GT(camera.camera().up.y, 0);
}

TEST(OrbitCamera, APointStaysOnThePlaneThatFacesTheCamera) {
  const OrbitCamera camera = camera_on(unit_box);
  const Vec3d held{0.2, 0.4, 0.1};
  const Vec3d moved = camera.on_facing_plane({100, 500}, held);
  const Camera seen = camera.camera();
  EXPECT_NEAR(dot(moved - held, normalized(seen.eye - seen.target)), 0, 1e-9);
  EXPECT_NEAR(camera.pixel_of(moved).x, 100, 1e-6);
  EXPECT_NEAR(camera.pixel_of(moved).y, 500, 1e-6);
}

}  // namespace
}  // namespace weft::viewer
