#include "weft/mesh/winding.h"

#include <gtest/gtest.h>

#include "tests/mesh/small_meshes.h"
#include "tests/support/random_points.h"
#include "weft/shapes.h"

namespace weft {
namespace {

TriangleMesh turned_inside_out(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// A cube from -1 to 1, its sides halved by diagonals.
TriangleMesh cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({i % 2 * 2.0 - 1, i / 2 % 2 * 2.0 - 1, i / 4 * 2.0 - 1});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// By solid angles [van Oosterom and Strackee 1983], which share nothing with rays.
double winding_by_angles(const TriangleMesh& mesh, Vec3d p) {
  double sum = 0;
  for (const Corners& t : corners_of(mesh)) {
    const Vec3d a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    const double below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    sum += 2 * std::atan2(dot(a, cross(b, c)), below);
  }
  return sum / (4 * pi);
}

TEST(Winding, AgreesWithSolidAnglesAroundAnyShape) {
  Random random(7);
  for (const char* name : {"torus", "knot", "mannequin", "double_torus"}) {
    const TriangleMesh mesh = make_shape(name);
    Box3d box;
    for (const Vec3d& p : mesh.positions) box.add(p);
    const WindingNumbers winding(corners_of(mesh));
    int inside = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3d e = box.extent();
      const Vec3d p =
          box.lower + Vec3d{e.x * random.uniform(), e.y * random.uniform(), e.z * random.uniform()};
      const int found = winding.at(p);
      EXPECT_NEAR(found, winding_by_angles(mesh, p), 1e-6) << name;
      inside += found;
    }
    EXPECT_GT(inside, 5) << name;
  }
}

TEST(Winding, IsTheSameByRaysAlongAnyAxisToEitherSide) {
  Random random(11);
  for (double Vec3d::*thin : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
    TriangleMesh mesh = make_shape("knot");
    for (Vec3d& p : mesh.positions) p.*thin *= 0.1;
    const WindingNumbers winding(corners_of(mesh));
    int inside = 0;
    for (int i = 0; i < 200; ++i) {
      // Near the surface, where both are many.
      const std::size_t near =
          static_cast<std::size_t>(random.uniform() * 0.999 * mesh.positions.size());
      Vec3d p = 0.95 * mesh.positions[near];
      p.*thin += 0.02 * (random.uniform() - 0.5);
      const int found = winding.at(p, {1, 1, 1});
      EXPECT_EQ(found, winding.at(p, {-1, -1, -1}));
      EXPECT_NEAR(found, winding_by_angles(mesh, p), 1e-6);
      inside += found;
    }
    EXPECT_GT(inside, 5);
    EXPECT_LT(inside, 195);
  }
}

TEST(Winding, RaysThroughEdgesAndCornersCountOnce) {
  const WindingNumbers winding(corners_of(cube()));
  // Straight below the middle of a diagonal, of an edge and of a corner, and beside them.
  EXPECT_EQ(winding.at({0, 0, 0}), 1);
  EXPECT_EQ(winding.at({0, -2, 0}), 0);
  EXPECT_EQ(winding.at({0, 2, 0}), 0);
  for (const Vec3d p : {Vec3d{1, -3, 0}, Vec3d{-1, -3, 0}, Vec3d{1, -3, 1}, Vec3d{-1, -3, -1},
                        Vec3d{0.5, -3, 1}, Vec3d{2, 0, 0}})
    EXPECT_EQ(winding.at(p), 0) << p.x << " " << p.z;
}

TEST(Winding, TellsPointsAnUlpFromTheSurface) {
  const WindingNumbers winding(corners_of(cube()));
  EXPECT_EQ(winding.at({0.3, std::nextafter(1.0, 0.0), 0.2}), 1);
  EXPECT_EQ(winding.at({0.3, std::nextafter(1.0, 2.0), 0.2}), 0);
  EXPECT_EQ(winding.at({std::nextafter(1.0, 0.0), 0.1, 0.2}), 1);
  EXPECT_EQ(winding.at({std::nextafter(1.0, 2.0), 0.1, 0.2}), 0);
}

TEST(Winding, CountsEveryLayerAroundAPoint) {
  EXPECT_EQ(WindingNumbers(corners_of(test::together(cube(), cube()))).at({0.1, 0.2, 0.3}), 2);
  EXPECT_EQ(WindingNumbers(corners_of(turned_inside_out(cube()))).at({0.1, 0.2, 0.3}), -1);
  TriangleMesh hollow = cube();
  for (Vec3d& p : hollow.positions) p = 0.5 * p;
  hollow = test::together(cube(), turned_inside_out(hollow));
  EXPECT_EQ(WindingNumbers(corners_of(hollow)).at({0.1, 0.2, 0.3}), 0);
  EXPECT_EQ(WindingNumbers(corners_of(hollow)).at({0.7, 0.2, 0.3}), 1);
}

TEST(Winding, FollowsCornersThatMove) {
  WindingNumbers winding(corners_of(cube()));
  for (Corners& t : winding.triangles())
    for (Vec3d& corner : t) corner.x += 5;
  winding.moved();
  EXPECT_EQ(winding.at({0.1, 0.2, 0.3}), 0);
  EXPECT_EQ(winding.at({5.1, 0.2, 0.3}), 1);
}

TEST(Winding, OnlyClosedOrientedSurfacesAreClosed) {
  EXPECT_TRUE(is_closed(cube().triangles));
  EXPECT_FALSE(is_closed(test::ring(5, false).triangles));
  TriangleMesh one_turned = cube();
  std::swap(one_turned.triangles[3][0], one_turned.triangles[3][1]);
  EXPECT_FALSE(is_closed(one_turned.triangles));
}

}  // namespace
}  // namespace weft
