#include "weft/collide/contacts/near_samples.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/core/random.h"

namespace weft::near_samples_test {
namespace {

constexpr int n = 17, body_size = 33;
constexpr KeptGap kept{0.01, 0.4};

/// A sheet next to a body that stands still.
struct SheetAtBody {
  SheetAtBody(const Body& of, int samples)
      : given(of),
        body_grid(given.positions.size(), given.mates, {}),
        grid(samples, none, {}),
        query(body_grid),
        cloth(samples) {
    ThreadTeam alone(1);
    query.place(given.positions, alone);
    body.number = 1;
    body.query = &query;
    body.start = body.end = &given.positions;
    body.placement = body.motion = 1;
  }

  BorderMates none;
  Body given;
  SurfaceGrid body_grid, grid;
  BodyQuery query;
  test::TestCloth cloth;
  ContactBody body;
};

/// A sheet that moves about a ball, each sample on a way of its own.
struct SheetAtBall : SheetAtBody {
  SheetAtBall() : SheetAtBody(test::octahedral_sphere(body_size, 0.3, {}), n) {
    cloth.place([](int r, int c) { return Vec3d{0.03 * (c - 8), 0.312, 0.03 * (r - 8)}; });
  }
  /// Moves every sample in the sheet's plane from where it is, by up to `most` along each axis, and
  /// to another height within the reach of contacts. [m]
  void step(Random& random, float most) {
    const auto some = [&](float up_to) {
      return up_to * static_cast<float>(2 * random.uniform() - 1);
    };
    cloth.start = cloth.position;
    for (int s = 0; s < n * n; ++s) {
      const Vec3f from = cloth.start.at(s);
      cloth.position.set(s, {from.x + some(most), 0.31F + some(0.006F), from.z + some(most)});
    }
  }
  /// The contact of a sample, by a search of the whole body.
  [[nodiscard]] std::optional<Contact> expected(int sample) const {
    ClothPoint point;
    point.samples[0] = sample;
    point.start = vec_cast<double>(cloth.start.at(sample));
    point.displacement = vec_cast<double>(cloth.position.at(sample)) - point.start;
    const BodyPoint at = *query.closest(point.start, HUGE_VAL);
    point.astray = query.behind(point.start, at);
    return contact_before(body, at, point, kept);
  }
};

/// What is known of earlier steps spares searches and changes nothing.
TEST(NearSamples, HaveTheContactsThatASearchOfTheWholeBodyFinds) {
  SheetAtBall scene;
  NearSamples near(scene.grid, kept, false);
  ThreadTeam team(2);
  Random random(3);
  int contacts = 0;
  for (int step = 0; step < 200; ++step) {
    scene.step(random, step % 5 == 4 ? 0.02F : 0.002F);
    near.find(scene.cloth.moving(), scene.body, {}, team);
    for (int s = 0; s < n * n; ++s) {
      std::vector<Contact> found;
      near.add_contact(scene.cloth.moving(), scene.body, s / n, s % n, found);
      const std::optional<Contact> expected = scene.expected(s);
      ASSERT_EQ(found.size(), expected ? 1U : 0U) << step << ", sample " << s;
      if (!expected) continue;
      ++contacts;
      EXPECT_EQ(found[0].samples[0], s);
      EXPECT_LT(length(found[0].normal - expected->normal), 1e-5F);
      EXPECT_NEAR(found[0].offset, expected->offset, 1e-6);
    }
  }
  EXPECT_GT(contacts, 500);
}

TEST(NearSamples, TellTheSmallestGap) {
  SheetAtBall scene;
  NearSamples near(scene.grid, kept, false);
  ThreadTeam team(2);
  const double middle = 0.312 - 0.3;
  EXPECT_NEAR(near.smallest_gap(scene.cloth.start, scene.body, 0.02, team), middle, 2e-3);
  EXPECT_EQ(near.smallest_gap(scene.cloth.start, scene.body, 0.005, team), HUGE_VAL);
  scene.cloth.start.set(8 * n + 8, {0, 0.29F, 0});
  EXPECT_NEAR(near.smallest_gap(scene.cloth.start, scene.body, 0.02, team), -0.01, 2e-3);
}

TEST(NearSamples, KnowWhichAreAstray) {
  SheetAtBall scene;
  scene.cloth.place([](int r, int c) { return Vec3d{0.03 * (c - 8), 0.296, 0.03 * (r - 8)}; });
  NearSamples near(scene.grid, kept, false);
  ThreadTeam team(1);
  const std::vector<char> deep(n * n, 1);
  near.find(scene.cloth.moving(), scene.body, {deep}, team);
  int astray = 0;
  for (int s = 0; s < n * n; ++s) {
    const NearSample* const one = near.find(s / n, s % n);
    const bool inside = length(vec_cast<double>(scene.cloth.start.at(s))) < 0.298;
    if (inside) {
      ASSERT_NE(one, nullptr);
      EXPECT_TRUE(one->astray) << s;
      EXPECT_LT(one->gap, 0);
      ++astray;
    } else if (one != nullptr && one->triangle >= 0) {
      EXPECT_EQ(one->astray, one->gap < 0) << s;
    }
  }
  EXPECT_GE(astray, 5);
}

/// A small sheet in the hole of a ring, which leaves it 1 cm of room.
struct SheetInHole : SheetAtBody {
  explicit SheetInHole(double from_the_axis) : SheetAtBody(test::torus(129, 0.105, 0.1), 5) {
    cloth.place([&](int r, int c) {
      return Vec3d{from_the_axis + 1e-4 * (c - 2), 1e-4 * (r - 2), 0};
    });
  }
  std::vector<Contact> contacts() {
    NearSamples near(grid, kept, false);
    ThreadTeam team(1);
    near.find(cloth.moving(), body, {}, team);
    std::vector<Contact> found;
    near.add_contact(cloth.moving(), body, 2, 2, found);
    return found;
  }
};

TEST(NearSamples, HaveBothSidesOfWhatLeavesNoRoom) {
  const std::vector<Contact> found = SheetInHole(0.001).contacts();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_LT(dot(found[0].normal, found[1].normal), -0.9F);
  // Each as far from its side as it was found: 6 and 4 mm from the axis.
  EXPECT_NEAR(found[0].offset + found[1].offset, 0, 2e-4);
}

TEST(NearSamples, HaveOneSideOfABodyThatMoves) {
  SheetInHole scene(0.001);
  const Planes3 end = scene.given.positions;
  scene.body.end = &end;
  EXPECT_EQ(scene.contacts().size(), 1U);
}

}  // namespace
}  // namespace weft::near_samples_test
