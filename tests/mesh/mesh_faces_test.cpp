#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "weft/core/math.h"
#include "weft/core/random.h"
#include "weft/files.h"
#include "weft/mesh.h"
#include "weft/mesh/io/polygon.h"
#include "weft/mesh/point_normals.h"
#include "weft/shapes.h"

namespace weft {
namespace {

using Numbers = std::vector<int>;
using Triangles = std::vector<Triangle>;

const std::string five = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\n";

MeshFile parse(const std::string& text) { return parse_obj_file(text, "a.obj"); }

TEST(MeshFaces, PolygonsOfAnObjStayWhole) {
  const MeshFile file = parse(five + "f 1 2 3 4\nf -1 3 2\n");
  EXPECT_EQ(file.faces.sizes, (Numbers{4, 3}));
  EXPECT_EQ(file.faces.corners, (Numbers{0, 1, 2, 3, 4, 2, 1}));
  EXPECT_FALSE(file.faces.has_texture());
  EXPECT_EQ(fans_of(file.faces).triangles, file.mesh.triangles);
}

// The shape of an L, with a corner in the middle of a side and its first corner where no fan covers
// it.
TEST(MeshFaces, PolygonsThatAreNotConvexDoNotFold) {
  const MeshFile file = parse(
      "v 0 2 0\nv 0 1 0\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\n"
      "vt 0 1\nvt 0 .5\nvt 0 0\nvt 1 0\nvt 1 .5\nvt .5 .5\nvt .5 1\n"
      "f 1/1 2/2 3/3 4/4 5/5 6/6 7/7\nf 1/1 3/3 2/2\n");
  ASSERT_EQ(file.mesh.triangles.size(), 6u);
  double area = 0;
  for (std::size_t t = 0; t < 5; ++t) {
    const auto& [a, b, c] = file.mesh.triangles[t];
    const std::vector<Vec3d>& p = file.mesh.positions;
    const double own = 0.5 * cross(p[b] - p[a], p[c] - p[a]).z;
    EXPECT_GT(own, 0) << "triangle " << t;
    area += own;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d at = p[static_cast<std::size_t>(file.mesh.triangles[t][k])];
      EXPECT_EQ(file.mesh.corner_uv[t][k],
                (Vec2f{0.5F * static_cast<float>(at.x), 0.5F * static_cast<float>(at.y)}));
    }
  }
  EXPECT_EQ(area, 3);
  EXPECT_EQ(fans_of(file.faces).triangles, file.mesh.triangles);
}

TEST(MeshFaces, EarsCoverEveryPolygonThatDoesNotCrossItself) {
  Random random(5);
  for (int round = 0; round < 200; ++round) {
    // A star about the origin, in a plane that leans, some corners twice.
    std::vector<Vec3d> corners;
    const int count = 4 + static_cast<int>(30 * random.uniform());
    for (int k = 0; k < count; ++k) {
      const double a = 2 * pi * k / count, r = 0.1 + random.uniform();
      corners.push_back({r * cosine(a), r * sine(a), 0.3 * r * cosine(a)});
      if (random.uniform() < 0.1) corners.push_back(corners.back());
    }
    const auto area_of = [&](int a, int b, int c) {
      return 0.5 * cross(corners[b] - corners[a], corners[c] - corners[a]).z;
    };
    double whole = 0, covered = 0;
    for (int k = 2; k < static_cast<int>(corners.size()); ++k) whole += area_of(0, k - 1, k);
    const Triangles split = split_polygon(corners);
    EXPECT_EQ(split.size(), corners.size() - 2);
    for (const auto& [a, b, c] : split) {
      EXPECT_GE(area_of(a, b, c), 0) << round;
      covered += area_of(a, b, c);
    }
    EXPECT_NEAR(covered, whole, 1e-12);
  }
}

// Nothing is known of what lies inside of it.
TEST(MeshFaces, APolygonThatCrossesItselfIsAFan) {
  const std::vector<Vec3d> star{
      {0, 1, 0}, {-0.6, -0.8, 0}, {0.95, 0.3, 0}, {-0.95, 0.3, 0}, {0.6, -0.8, 0}};
  EXPECT_EQ(split_polygon(star), (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  const std::vector<Vec3d> large{{0, 0, 0}, {1e300, 0, 0}, {1e299, 1e299, 0}, {0, 1e300, 0}};
  EXPECT_EQ(split_polygon(large), (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(MeshFaces, TextureIndicesAreTheAuthorsOwn) {
  // The second coordinate is used by nobody and the last two are equal: all stay.
  const std::string texture = "vt 0 0\nvt 9 9\nvt 1 0\nvt 1 1\nvt 1 1 0.5\n";
  const MeshFile file = parse(five + texture + "f 1/1 2/3 3/5\nf 1/1 3/-2 4/-4\n");
  EXPECT_EQ(file.faces.texture, (std::vector<Vec2f>{{0, 0}, {9, 9}, {1, 0}, {1, 1}, {1, 1}}));
  EXPECT_EQ(file.faces.texture_corners, (Numbers{0, 2, 4, 0, 3, 1}));
}

TEST(MeshFaces, CornersWithoutTextureAreTold) {
  const std::string texture = "vt 0 0\nvt 1\nvt 0.5 0.5\n";
  const MeshFile file = parse(five + texture + "f 1/1 2/2 3/7\nf 1 3 4\n");
  EXPECT_EQ(file.faces.texture_corners, (Numbers{0, -1, -1, -1, -1, -1}));
  EXPECT_TRUE(parse(five + texture + "f 1/2 2/2 3/2\n").faces.texture_corners.empty());
}

TEST(MeshFaces, EqualTextureCoordinatesOfAVertexBecomeOne) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                          {{0, 1, 2}, {0, 2, 3}},
                          {{{{0, 0}, {1, 0}, {1, 1}}}, {{{0, 0}, {0.5F, 0.5F}, {0, 1}}}}};
  const MeshFaces faces = faces_of(mesh);
  EXPECT_EQ(faces.corners, (Numbers{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(faces.texture, (std::vector<Vec2f>{{0, 0}, {1, 0}, {1, 1}, {0.5F, 0.5F}, {0, 1}}));
  EXPECT_EQ(faces.texture_corners, (Numbers{0, 1, 2, 0, 3, 4}));
}

TEST(MeshFaces, FilesOfOtherFormatsHaveTriangles) {
  const test::TemporaryFolder folder;
  const TriangleMesh box = make_shape("box");
  write_mesh(folder / "box.ply", box);
  const MeshFile file = read_mesh_file(folder / "box.ply");
  EXPECT_EQ(file.faces.sizes, Numbers(box.triangles.size(), 3));
  EXPECT_EQ(fans_of(file.faces).triangles, box.triangles);
  EXPECT_EQ(file.mesh.positions, box.positions);
}

TEST(PointNormals, AreTheSumOfAreasAround) {
  // A roof: the ridge's normal leans to the larger side.
  const std::vector<Vec3f> points{{0, 0, 0}, {0, 0, 1}, {-1, -1, 0}, {3, -3, 0}, {7, 7, 7}};
  const std::vector<Vec3f> normals = point_normals(points, Triangles{{0, 2, 1}, {0, 1, 3}});
  const auto expect_near = [](Vec3f found, Vec3d wanted) {
    EXPECT_NEAR(found.x, wanted.x, 1e-6);
    EXPECT_NEAR(found.y, wanted.y, 1e-6);
    EXPECT_NEAR(found.z, wanted.z, 1e-6);
  };
  expect_near(normals[0], normalized(Vec3d{-1 + 3, 1 + 3, 0}));
  expect_near(normals[2], normalized(Vec3d{-1, 1, 0}));
  expect_near(normals[4], {0, 1, 0});
}

TEST(Units, PointsGoToAFrameAndBack) {
  const MeshFrame inches{*find_length_unit("in"), true};
  const Vec3d point{1, 2, 3};
  const Vec3d there = in_frame(point, inches);
  EXPECT_NEAR(there.x, 1 / 0.0254, 1e-12);
  EXPECT_NEAR(there.y, -3 / 0.0254, 1e-12);
  EXPECT_NEAR(there.z, 2 / 0.0254, 1e-12);
  EXPECT_NEAR(length(in_metres_y_up(there, inches) - point), 0, 1e-15);
  EXPECT_FALSE(find_length_unit("furlong").has_value());
}

}  // namespace
}  // namespace weft
