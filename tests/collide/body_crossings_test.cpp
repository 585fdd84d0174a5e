#include "weft/collide/contacts/body_crossings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/collide/broad_phase/tiling.h"
#include "weft/collide/contacts/closest.h"
#include "weft/core/contact_point.h"
#include "weft/mesh/crossings.h"

namespace weft::body_crossings_test {
namespace {

using test::TestCloth;

constexpr int n = 9, body_size = 17;
constexpr double spacing = 0.1, gap = 0.004;

/// A flat sheet and an octahedron whose upper tip is 2 cm above it, far from all samples.
struct TipThroughSheet {
  explicit TipThroughSheet(double above = 0.02)
      : given(test::octahedron(body_size, {0.3, 0.6, 0.3}, {0.02, above - 0.6, 0.03})),
        grid(n, none, {}),
        body_grid(body_size, given.mates, {}),
        query(body_grid),
        cloth(n) {
    cloth.place([](int r, int c) { return Vec3d{spacing * (c - 4.5), 0, spacing * (r - 4.5)}; });
    query.place(given.positions, team);
    body.number = 1;
    body.query = &query;
    body.start = body.end = &given.positions;
  }
  /// Looks at all pairs of cells.
  void find(int threads = 2) {
    ThreadTeam several(threads);
    std::vector<CandidateTile> all;
    for (int r = 0; r < n - 1; ++r)
      for (int c = 0; c < n - 1; ++c)
        for (int row = 0; row < body_size - 1; row += Tiling::rows)
          for (int col = 0; col < body_size - 1; col += Tiling::cols)
            all.push_back({static_cast<std::uint16_t>(r), static_cast<std::uint16_t>(c),
                           static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(col), 255});
    crossings.find({grid, cloth.start, body_grid, body}, all, several);
  }
  [[nodiscard]] std::vector<int> crossed() const {
    std::vector<int> found;
    for (int t = 0; t < 2 * (n - 1) * (n - 1); ++t)
      if (crossings.crosses(t / 2, t % 2)) found.push_back(t);
    return found;
  }
  [[nodiscard]] std::vector<int> truly_crossed() const {
    std::vector<int> found;
    for (int t = 0; t < 2 * (n - 1) * (n - 1); ++t)
      if (crosses(grid.triangle(t / 2, t % 2))) found.push_back(t);
    return found;
  }
  [[nodiscard]] bool crosses(const std::array<int, 3>& samples) const {
    for (int t = 0; t < 2 * (body_size - 1) * (body_size - 1); ++t)
      if (triangles_cross(corners_at(cloth.start, samples),
                          corners_at(given.positions, body_grid.triangle(t / 2, t % 2))))
        return true;
    return false;
  }
  [[nodiscard]] std::vector<Contact> contacts(bool kept_in = false) {
    std::vector<Contact> found;
    crossings.add_contacts(grid, cloth.moving(), body, {{gap, 0.4}, 0.0005, kept_in, inside},
                           found);
    return found;
  }

  BorderMates none;
  Body given;
  SurfaceGrid grid, body_grid;
  BodyQuery query;
  TestCloth cloth;
  ContactBody body;
  BodyCrossings crossings;
  InsideMarks inside = InsideMarks(n * n, 0);
  ThreadTeam team{1};
};

TEST(BodyCrossings, AreTheTrianglesThatCross) {
  for (const double above : {0.001, 0.02, 0.1, 0.3}) {
    TipThroughSheet scene(above);
    scene.find();
    EXPECT_FALSE(scene.crossed().empty());
    EXPECT_EQ(scene.crossed(), scene.truly_crossed()) << above;
    EXPECT_TRUE(scene.crossings.is_open());
  }
}

TEST(BodyCrossings, HaveContactsThatLeadOutByNoMoreThanIsAllowed) {
  TipThroughSheet scene;
  scene.find();
  const std::vector<Contact> contacts = scene.contacts();
  ASSERT_EQ(contacts.size(), scene.crossed().size());
  for (const Contact& contact : contacts) {
    EXPECT_NEAR(std::accumulate(contact.weights.begin(), contact.weights.end(), 0.0F), 1, 1e-6);
    EXPECT_GT(contact.normal.y, 0.2F);  // the tip is above the sheet, which leaves upwards
    EXPECT_NEAR(depth_of(contact, scene.cloth.start), 0.0005, 1e-6);
    EXPECT_EQ(contact.friction, 0);
  }
}

TEST(BodyCrossings, HaveNoContactsWhereASampleHasItsOwn) {
  TipThroughSheet scene;
  scene.find();
  for (const int t : scene.crossed())
    for (const int s : scene.grid.triangle(t / 2, t % 2)) scene.inside[s] = scene.body.number;
  EXPECT_TRUE(scene.contacts().empty());
}

TEST(BodyCrossings, AreNotLookedForOnceThereAreNone) {
  TipThroughSheet scene(-0.001);
  EXPECT_TRUE(scene.crossings.is_open());
  scene.find();
  EXPECT_FALSE(scene.crossings.is_open());
  EXPECT_TRUE(scene.crossed().empty());
  EXPECT_TRUE(scene.contacts().empty());
  scene.crossings.recheck();
  EXPECT_TRUE(scene.crossings.is_open());
}

TEST(BodyCrossings, AreTheSameOnEveryTeam) {
  TipThroughSheet one(0.1), seven(0.1);
  one.find(1);
  seven.find(7);
  const std::vector<Contact> expected = one.contacts(), found = seven.contacts();
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].samples, expected[k].samples);
    EXPECT_EQ(found[k].weights, expected[k].weights);
    EXPECT_EQ(found[k].offset, expected[k].offset);
  }
}

TEST(BodyCrossings, HaveNoContactsInsideOfWhatKeepsTheClothIn) {
  TipThroughSheet scene;
  scene.find();
  EXPECT_TRUE(scene.contacts(true).empty());
}

TEST(BodyCrossings, OfAnotherStateAreForgotten) {
  TipThroughSheet scene;
  scene.find();
  scene.crossings.forget();
  EXPECT_TRUE(scene.crossed().empty());
  EXPECT_TRUE(scene.crossings.is_open());
}

}  // namespace
}  // namespace weft::body_crossings_test
