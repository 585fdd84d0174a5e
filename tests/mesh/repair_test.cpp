#include "weft/repair.h"

#include <algorithm>
#include <array>
#include <limits>

#include <gtest/gtest.h>

#include "tests/mesh/small_meshes.h"
#include "tests/support/errors.h"
#include "tests/support/meshes.h"
#include "weft/core/random.h"

namespace weft {
namespace {

using Sentences = std::vector<std::string>;

RepairOptions named(ComponentChoice choice = {}) { return {"thing.obj", choice}; }

RepairedMesh repaired(const TriangleMesh& mesh, ComponentChoice choice = {}) {
  return repair_mesh(mesh, named(choice));
}

template <class Wanted>
std::string refusal(const TriangleMesh& mesh, ComponentChoice choice = {}) {
  return test::message_of<Wanted>([&] { repaired(mesh, choice); });
}

void turn(Triangle& t) { std::swap(t[1], t[2]); }

/// Two tetrahedra of different size; the larger one comes last.
TriangleMesh two_tetrahedra() {
  TriangleMesh large = test::tetrahedron();
  for (Vec3d& p : large.positions) p = 3.0 * p + Vec3d{5, 0, 0};
  return test::together(test::tetrahedron(), large);
}

TEST(Repair, SoundMeshIsLeftAlone) {
  const TriangleMesh mesh = test::torus(5, 7);
  const RepairedMesh result = repaired(mesh);
  EXPECT_EQ(result.mesh.positions, mesh.positions);
  EXPECT_EQ(result.mesh.triangles, mesh.triangles);
  EXPECT_TRUE(result.repairs.empty());
  EXPECT_EQ(result.counts.genus, 1);
}

TEST(Repair, FewWrongTrianglesAreTurnedToTheMajority) {
  const TriangleMesh good = test::torus(9, 11);
  TriangleMesh mesh = good;
  for (const int t : {0, 17, 18, 101}) turn(mesh.triangles[t]);
  const RepairedMesh result = repaired(mesh);
  EXPECT_EQ(result.mesh.triangles, good.triangles);
  EXPECT_EQ(result.repairs, Sentences{"oriented 4 triangles"});
}

TEST(Repair, AnyMixOfOrientationsOfAClosedSurfaceEndsOutward) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    TriangleMesh mesh = test::torus(6, 8);
    const double volume = test::volume_of(mesh);
    for (Triangle& t : mesh.triangles)
      if (random.uniform() < 0.5) turn(t);
    const RepairedMesh result = repaired(mesh);
    EXPECT_NEAR(test::volume_of(result.mesh), volume, 1e-9);
    EXPECT_EQ(result.counts.genus, 1);
  }
}

TEST(Repair, InsideOutClosedSurfaceIsTurnedAndSaysSo) {
  TriangleMesh mesh = test::tetrahedron();
  for (Triangle& t : mesh.triangles) turn(t);
  const RepairedMesh result = repaired(mesh);
  EXPECT_GT(test::volume_of(result.mesh), 0);
  EXPECT_EQ(result.repairs, Sentences{"turned the closed surface outward, 4 triangles"});
}

TEST(Repair, OpenSurfaceKeepsItsMajorityEvenWhenItFacesDown) {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 2, 1}, {0, 3, 2}}};
  EXPECT_EQ(repaired(mesh).mesh.triangles, mesh.triangles);
  EXPECT_TRUE(repaired(mesh).repairs.empty());
}

TEST(Repair, SingleTriangleIsADisk) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 0, 2}}};
  const RepairedMesh result = repaired(mesh);
  EXPECT_EQ(result.counts.boundaries, 1);
  EXPECT_EQ(result.counts.euler, 1);
  EXPECT_TRUE(result.repairs.empty());
}

TEST(Repair, MoebiusStripIsRefusedWithAnEdge) {
  EXPECT_EQ(repaired(test::ring(7, false)).counts.boundaries, 2);
  const std::string message = refusal<TopologyError>(test::ring(7, true));
  EXPECT_NE(message.find("thing.obj: the surface is not orientable"), std::string::npos) << message;
  EXPECT_NE(message.find("edge between vertices"), std::string::npos) << message;
}

TEST(Repair, TrianglesWithARepeatedVertexGoAndLeaveTheRest) {
  TriangleMesh mesh = test::tetrahedron();
  mesh.triangles.insert(mesh.triangles.begin() + 1, {2, 2, 3});
  mesh.triangles.push_back({1, 0, 1});
  const RepairedMesh result = repaired(mesh);
  EXPECT_EQ(result.mesh.triangles, test::tetrahedron().triangles);
  EXPECT_EQ(result.repairs, Sentences{"dropped 2 triangles with a repeated vertex"});
}

TEST(Repair, DuplicatesInAnyOrderOfCornersGo) {
  TriangleMesh mesh = test::tetrahedron();
  mesh.triangles.push_back({2, 1, 0});
  mesh.triangles.push_back({3, 0, 2});
  mesh.triangles.push_back({3, 0, 2});
  const RepairedMesh result = repaired(mesh);
  EXPECT_EQ(result.mesh.triangles, test::tetrahedron().triangles);
  EXPECT_EQ(result.repairs, Sentences{"dropped 3 triangles with the same vertices as another"});
}

TEST(Repair, UnreferencedVerticesGoAndTheRestKnowTheirSource) {
  TriangleMesh mesh = test::tetrahedron();
  mesh.positions.insert(mesh.positions.begin(), {7, 7, 7});
  mesh.positions.push_back({8, 8, 8});
  for (Triangle& t : mesh.triangles)
    for (int& v : t) ++v;
  const RepairedMesh result = repaired(mesh);
  EXPECT_EQ(result.mesh.positions, test::tetrahedron().positions);
  EXPECT_EQ(result.source_vertex, (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(result.repairs, Sentences{"dropped 2 vertices without triangles"});
}

TEST(Repair, TrianglesKnowTheirSourceAndKeepTheirTextureCoordinates) {
  TriangleMesh mesh = test::tetrahedron();
  std::swap(mesh.triangles[2][1], mesh.triangles[2][2]);
  mesh.triangles.insert(mesh.triangles.begin() + 1, {2, 2, 3});
  mesh.positions.insert(mesh.positions.begin(), {7, 7, 7});
  for (int t = 0; t < 5; ++t) {
    for (int& v : mesh.triangles[t]) ++v;
    // What each corner has tells its triangle and its vertex.
    std::array<Vec2f, 3> corners;
    for (int k = 0; k < 3; ++k)
      corners[k] = {static_cast<float>(t), static_cast<float>(mesh.triangles[t][k])};
    mesh.corner_uv.push_back(corners);
  }
  const RepairedMesh result = repaired(mesh);
  EXPECT_EQ(result.source_triangle, (std::vector<int>{0, 2, 3, 4}));
  ASSERT_EQ(result.mesh.corner_uv.size(), 4U);
  for (int t = 0; t < 4; ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(result.mesh.corner_uv[t][k],
                (Vec2f{static_cast<float>(result.source_triangle[t]),
                       static_cast<float>(result.source_vertex[result.mesh.triangles[t][k]])}));
}

TEST(Repair, PinchedVertexIsSplitIntoItsFans) {
  // A ring whose two borders are pinched together at one vertex.
  TriangleMesh mesh = test::ring(8, false);
  for (Triangle& t : mesh.triangles)
    for (int& v : t)
      if (v == 9) v = 0;
  const RepairedMesh result = repaired(mesh);
  EXPECT_EQ(result.repairs, (Sentences{"dropped 1 vertex without triangles",
                                       "split 1 non-manifold vertex into 2 fans"}));
  EXPECT_EQ(result.counts.vertices, 16);
  EXPECT_EQ(result.counts.boundaries, 2);
  EXPECT_EQ(result.source_vertex.back(), 0);
  EXPECT_EQ(result.mesh.positions.back(), mesh.positions[0]);
}

TEST(Repair, NonManifoldEdgesAreCountedAndTheFirstIsNamed) {
  TriangleMesh mesh = test::torus(5, 7);
  mesh.positions.push_back({0, 9, 0});
  mesh.triangles.push_back({10, 9, 35});
  mesh.triangles.push_back({2, 3, 35});
  const std::string message = refusal<TopologyError>(mesh);
  EXPECT_EQ(
      message,
      "thing.obj: 2 non-manifold edges, the first between vertices 2 and 3 (counted from 0) with "
      "3 triangles; at most two triangles at an edge are wanted");
}

TEST(Repair, SeveralComponentsAreRefusedUnlessOneIsChosen) {
  const std::string message = refusal<TopologyError>(two_tetrahedra());
  EXPECT_NE(message.find("2 components"), std::string::npos) << message;
  EXPECT_NE(message.find("--component"), std::string::npos) << message;
}

TEST(Repair, ComponentsAreNumberedByArea) {
  const RepairedMesh largest = repaired(two_tetrahedra(), {ComponentChoice::Kind::largest, 0});
  EXPECT_EQ(largest.source_vertex, (std::vector<int>{4, 5, 6, 7}));
  EXPECT_EQ(largest.components_found, 2);
  EXPECT_EQ(largest.repairs, Sentences{"kept component 0 of 2 with 4 of 8 triangles"});
  const RepairedMesh second = repaired(two_tetrahedra(), {ComponentChoice::Kind::index, 1});
  EXPECT_EQ(second.source_vertex, (std::vector<int>{0, 1, 2, 3}));
}

TEST(Repair, ComponentsOfEqualAreaAreNumberedByLeastVertex) {
  TriangleMesh mesh = test::together(test::tetrahedron(), test::tetrahedron());
  std::reverse(mesh.triangles.begin(), mesh.triangles.end());
  const RepairedMesh result = repaired(mesh, {ComponentChoice::Kind::index, 0});
  EXPECT_EQ(result.source_vertex, (std::vector<int>{0, 1, 2, 3}));
}

TEST(Repair, ComponentThatIsNotThereIsRefused) {
  const std::string message =
      refusal<TopologyError>(two_tetrahedra(), {ComponentChoice::Kind::index, 2});
  EXPECT_NE(message.find("component 2 of 2"), std::string::npos) << message;
}

TEST(Repair, SoundComponentIsKeptBesideABrokenOne) {
  const TriangleMesh book{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
                          {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
  const TriangleMesh mesh = test::together(test::torus(5, 7), book);
  EXPECT_NE(refusal<TopologyError>(mesh).find("non-manifold edge"), std::string::npos);
  EXPECT_EQ(repaired(mesh, {ComponentChoice::Kind::largest, 0}).counts.genus, 1);
  EXPECT_NE(refusal<TopologyError>(mesh, {ComponentChoice::Kind::index, 1}).find("non-manifold"),
            std::string::npos);
}

TEST(Repair, TrianglesWithoutAreaStay) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 2, 3}, {0, 1, 2}}};
  const RepairedMesh result = repaired(mesh);
  EXPECT_EQ(result.mesh.triangles.size(), 2U);
  EXPECT_TRUE(result.repairs.empty());
}

TEST(Repair, BadValuesAreInputErrors) {
  TriangleMesh mesh = test::tetrahedron();
  mesh.positions[2].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal<InputError>(mesh).find("vertex 2"), std::string::npos);
  mesh.positions[2].y = 1e200;
  EXPECT_NE(refusal<InputError>(mesh).find("1e30"), std::string::npos);
  mesh = test::tetrahedron();
  mesh.triangles[1][2] = 4;
  EXPECT_NE(refusal<InputError>(mesh).find("triangle 1 uses vertex 4 of 4"), std::string::npos);
  mesh.triangles[1][2] = -1;
  EXPECT_NE(refusal<InputError>(mesh).find("vertex -1"), std::string::npos);
  EXPECT_NE(refusal<InputError>({}).find("no vertices"), std::string::npos);
  EXPECT_NE(refusal<InputError>({mesh.positions, {}}).find("no triangles"), std::string::npos);
  EXPECT_NE(refusal<InputError>({mesh.positions, {{1, 1, 2}}}).find("repeated vertex"),
            std::string::npos);
}

TEST(Repair, WeldJoinsEqualPositionsInOrderOfFirstOccurrence) {
  const TriangleMesh soup{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 0}, {-0.0, 0, 1}, {2, 2, 2}},
                          {{0, 1, 2}, {3, 4, 5}}};
  const TriangleMesh welded = weld_exact(soup);
  EXPECT_EQ(welded.positions, (std::vector<Vec3d>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 2}}));
  EXPECT_EQ(welded.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 2, 3}}));
}

/// Every corner of every triangle its own vertex, as files without indices have them.
TriangleMesh soup_of(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const Triangle& t : mesh.triangles) {
    const int first = static_cast<int>(soup.positions.size());
    for (const int v : t) soup.positions.push_back(mesh.positions[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

const ComponentChoice all{ComponentChoice::Kind::all};

TEST(Repair, ASoupOfTrianglesIsWelded) {
  const TriangleMesh torus = test::torus(5, 7);
  const RepairedMesh result = repaired(soup_of(torus), all);
  EXPECT_EQ(result.mesh.positions.size(), torus.positions.size());
  EXPECT_EQ(result.counts.genus, 1);
  EXPECT_EQ(result.components_found, 1);
  EXPECT_EQ(result.repairs,
            Sentences{"welded 175 vertices to others at the same position, which closes 210 "
                      "border edges"});
}

TEST(Repair, WeldedVerticesKnowTheFirstAtTheirPosition) {
  const TriangleMesh soup = soup_of(test::tetrahedron());
  const RepairedMesh result = repaired(soup, all);
  ASSERT_EQ(result.welded.size(), soup.positions.size());
  for (std::size_t v = 0; v < soup.positions.size(); ++v) {
    EXPECT_EQ(soup.positions[result.welded[v]], soup.positions[v]);
    EXPECT_LE(result.welded[v], static_cast<int>(v));
  }
}

TEST(Repair, WeldingKeepsTheTextureCoordinatesOfCorners) {
  TriangleMesh soup = soup_of(test::tetrahedron());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    soup.corner_uv.push_back({Vec2f{float(t), 0}, Vec2f{float(t), 1}, Vec2f{float(t), 2}});
  const RepairedMesh result = repaired(soup, all);
  ASSERT_EQ(result.mesh.corner_uv.size(), soup.triangles.size());
  for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Vec2f uv = result.mesh.corner_uv[t][k];
      const Vec3d there = soup.positions[soup.triangles[std::size_t(uv.x)][std::size_t(uv.y)]];
      EXPECT_EQ(result.mesh.positions[result.mesh.triangles[t][k]], there);
    }
}

TEST(Repair, IslandsOfTheTextureAreTheSameWhateverWayTrianglesFace) {
  TriangleMesh mesh = test::torus(6, 8);
  for (const Triangle& t : mesh.triangles) {
    std::array<Vec2f, 3> corners;
    const bool left = mesh.positions[t[0]].x + mesh.positions[t[1]].x + mesh.positions[t[2]].x < 0;
    for (int k = 0; k < 3; ++k) corners[k] = {float(t[k]), left ? 1.0F : 0.0F};
    mesh.corner_uv.push_back(corners);
  }
  RepairOptions options = named(all);
  options.part.at_texture_seams = true;
  const RepairedMesh wanted = repair_mesh(mesh, options);
  for (const int t : {3, 10, 11, 40, 57}) {
    turn(mesh.triangles[t]);
    std::swap(mesh.corner_uv[t][1], mesh.corner_uv[t][2]);
  }
  const RepairedMesh found = repair_mesh(mesh, options);
  EXPECT_EQ(wanted.repairs.size(), 1U);
  EXPECT_EQ(found.repairs, (Sentences{"oriented 5 triangles", wanted.repairs[0]}));
  EXPECT_EQ(found.mesh.positions.size(), wanted.mesh.positions.size());
}

TEST(Repair, PiecesThatTouchWithoutClosingBordersAreNotWelded) {
  const TriangleMesh one = test::tetrahedron();
  TriangleMesh other = one;  // shares one vertex's position with the first
  const Vec3d moved = one.positions[0] - one.positions[1];
  for (Vec3d& p : other.positions) p = p + moved;
  const RepairedMesh result = repaired(test::together(one, other), all);
  EXPECT_TRUE(result.welded.empty());
  EXPECT_EQ(result.components_found, 2);
}

TEST(Repair, RefusesWhatHasNoAreaAtAll) {
  TriangleMesh line;
  line.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  line.triangles = {{0, 1, 2}, {1, 2, 3}};
  EXPECT_THROW(repair_mesh(line, {}), InputError);
  line.positions[3].y = 1e-9;  // one triangle with an area is enough
  EXPECT_EQ(repair_mesh(line, {}).counts.triangles, 2);
}

}  // namespace
}  // namespace weft
