#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/collide/ccd.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/contact_point.h"
#include "weft/core/random.h"

namespace weft::contact_pipeline_test {
namespace {

using test::octahedral_sphere;
using test::TestCloth;

constexpr double step = 1.0 / 240;

/// One surface's primitives on their way, for looking at every pair there is.
struct Primitives {
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> edges;
  const Planes3 *start, *end;

  Primitives(const SurfaceGrid& grid, const Planes3& from, const Planes3& to)
      : start(&from), end(&to) {
    for (int t = 0; t < 2 * grid.cells() * grid.cells(); ++t) {
      const std::array<int, 3> samples = grid.triangle(t / 2, t % 2);
      if (grid.folded(samples)) continue;
      triangles.push_back({grid.point(samples[0]), grid.point(samples[1]), grid.point(samples[2])});
      for (std::size_t k = 0; k < 3; ++k) {
        const int p = triangles.back()[k], q = triangles.back()[(k + 1) % 3];
        if (p < q) edges.push_back({p, q});
      }
    }
  }
};

Vec3d at(const Planes3& planes, int sample) { return vec_cast<double>(planes.at(sample)); }

template <class First, class Second>
bool share(const First& a, const Second& b) {
  for (const int p : a)
    for (const int q : b)
      if (p == q) return true;
  return false;
}

int vertices_through_faces(const Primitives& a, const Primitives& b, bool same) {
  int hits = 0;
  const int n = a.start->size();
  for (int v = 0; v < n * n; ++v)
    for (const std::array<int, 3>& t : b.triangles) {
      if (same && share(std::array{v}, t)) continue;
      const auto posed = [&](const Planes3& p, const Planes3& q) {
        return VertexFace{at(p, v), {at(q, t[0]), at(q, t[1]), at(q, t[2])}};
      };
      if (time_of_impact(posed(*a.start, *b.start), posed(*a.end, *b.end))) ++hits;
    }
  return hits;
}

int edges_through_edges(const Primitives& a, const Primitives& b, bool same) {
  int hits = 0;
  for (const std::array<int, 2>& e : a.edges)
    for (const std::array<int, 2>& f : b.edges) {
      if (same && (share(e, f) || f < e)) continue;
      const auto posed = [&](const Planes3& p, const Planes3& q) {
        return EdgeEdge{{at(p, e[0]), at(p, e[1])}, {at(q, f[0]), at(q, f[1])}};
      };
      if (time_of_impact(posed(*a.start, *b.start), posed(*a.end, *b.end))) ++hits;
    }
  return hits;
}

/// How many pairs of primitives of two surfaces, or of one with itself, meet on their way, by
/// continuous detection, which shares nothing with the filter.
int meetings(const Primitives& a, const Primitives& b, bool same) {
  return vertices_through_faces(a, b, same) + (same ? 0 : vertices_through_faces(b, a, false)) +
         edges_through_edges(a, b, same);
}

/// A sheet of waves, all samples of which are thrown about.
void throw_about(TestCloth& cloth, Random& random, double strength) {
  const int n = cloth.start.size();
  cloth.place([&](int r, int c) {
    return Vec3d{0.1 * c, 0.3 + 0.08 * ((r / 2) % 2) + 0.01 * c, 0.05 * r};
  });
  for (int s = 0; s < n * n; ++s) {
    const auto any = [&] { return random.uniform(-strength, strength); };
    cloth.position.set(s, cloth.start.at(s) + vec_cast<float>(Vec3d{any(), any() - 0.1, any()}));
  }
}

CollidingCloth statistics(const BorderMates& mates, int n) {
  return {.mates = mates,
          .size = n,
          .thickness = 0.004,
          .rest_spacing = 0.1,
          .self_collision = true,
          .self_thickness = 0.004};
}

TEST(ContactPipeline, NothingPassesThroughItselfOrABodyHoweverItIsThrown) {
  constexpr int n = 9;
  const BorderMates none;
  const SurfaceGrid grid(n, none, {});
  Obstacles obstacles;
  obstacles.bodies.push_back(octahedral_sphere(9, 0.25, {0.4, 0, 0.2}));
  const SurfaceGrid body_grid(9, obstacles.bodies[0].mates, {});
  const Planes3& body = obstacles.bodies[0].positions;
  const CollidingCloth cloth_properties = statistics(none, n);
  Random random(3);
  int before = 0, stopped = 0;
  for (int round = 0; round < 12; ++round) {
    const auto collider =
        make_collider(PyramidOptions{}, obstacles, std::span(&cloth_properties, 1));
    TestCloth cloth(n);
    throw_about(cloth, random, 0.02 * (round + 1));
    ThreadTeam team(2);
    const MovingCloth moving = cloth.moving();
    const Primitives sphere(body_grid, body, body);
    const Primitives thrown(grid, cloth.start, cloth.position);
    before += meetings(thrown, thrown, true) + meetings(thrown, sphere, false);
    collider->detect(std::span(&moving, 1), step, team);
    stopped += collider->filter(std::span(&moving, 1), step, team).stopped;
    EXPECT_EQ(meetings(thrown, thrown, true), 0) << round;
    EXPECT_EQ(meetings(thrown, sphere, false), 0) << round;
  }
  EXPECT_GT(before, 500);
  EXPECT_GT(stopped, 0);
}

/// Where a body is that turns about z by an angle while it rises.
Planes3 turned_up(const Planes3& body, double angle, double rise) {
  Planes3 end(body.size());
  for (int s = 0; s < body.size() * body.size(); ++s) {
    const Vec3d p = at(body, s);
    const Vec3d turned{cosine(angle) * p.x - sine(angle) * p.y,
                       sine(angle) * p.x + cosine(angle) * p.y + rise, p.z};
    end.set(s, vec_cast<float>(turned));
  }
  return end;
}

TEST(ContactPipeline, ABodyThatTurnsIntoAPileTakesItAlong) {
  constexpr int n = 9;
  const BorderMates none;
  const SurfaceGrid grid(n, none, {});
  Obstacles obstacles;
  obstacles.bodies.push_back(octahedral_sphere(9, 0.25, {0, 0, 0}));
  const Planes3& body = obstacles.bodies[0].positions;
  const SurfaceGrid body_grid(9, obstacles.bodies[0].mates, {});
  const CollidingCloth cloth_properties = statistics(none, n);
  for (int round = 1; round < 8; ++round) {
    const auto collider =
        make_collider(PyramidOptions{}, obstacles, std::span(&cloth_properties, 1));
    // Eight narrow layers, hardly apart, that would rather stay.
    TestCloth cloth(n);
    cloth.place([&](int r, int c) {
      return Vec3d{0.1 * (r % 2) - 0.05, 0.2501 + 1e-5 * r, 0.05 * (c - 4)};
    });
    ThreadTeam team(2);
    const MovingCloth moving = cloth.moving();
    const Planes3 end = turned_up(body, 0.01 * round, 0.002 * round);
    const Planes3* const ends[] = {&end};
    collider->move_bodies(ends, team);
    collider->detect(std::span(&moving, 1), step, team);
    collider->filter(std::span(&moving, 1), step, team);
    const Primitives pile(grid, cloth.start, cloth.position), sphere(body_grid, body, end);
    EXPECT_EQ(meetings(pile, pile, true), 0) << round;
    EXPECT_EQ(meetings(pile, sphere, false), 0) << round;
  }
}

TEST(ContactPipeline, AStepThatIsDiscardedIsFilteredUntilPointsFallBack) {
  constexpr int n = 9;
  const BorderMates none;
  Obstacles obstacles;
  obstacles.bodies.push_back(octahedral_sphere(9, 0.25, {0.4, 0, 0.2}));
  const CollidingCloth cloth_properties = statistics(none, n);
  ThreadTeam team(2);
  const auto filter = [&](int round, FilterEnd end, TestCloth& cloth) {
    const auto collider =
        make_collider(PyramidOptions{}, obstacles, std::span(&cloth_properties, 1));
    Random random(static_cast<std::uint64_t>(round));
    throw_about(cloth, random, 0.02 * (round + 1));
    const Planes3 turned = turned_up(obstacles.bodies[0].positions, 0.1 * round, 0.02 * round);
    const Planes3* const ends[] = {&turned};
    const MovingCloth moving = cloth.moving();
    collider->move_bodies(ends, team);
    collider->detect(std::span(&moving, 1), step, team);
    return collider->filter(std::span(&moving, 1), step, team, end);
  };
  int fallen = 0, free = 0, elsewhere = 0;
  for (int round = 0; round < 12; ++round) {
    TestCloth whole(n), shortened(n);
    const FilterCounts all = filter(round, FilterEnd::whole, whole);
    const FilterCounts some = filter(round, FilterEnd::unless_falls, shortened);
    ASSERT_EQ(some.fell_back > 0, all.fell_back > 0) << round;
    int other = 0;
    for (int s = 0; s < n * n; ++s)
      other += whole.position.at(s) == shortened.position.at(s) ? 0 : 1;
    ++(all.fell_back > 0 ? fallen : free);
    if (all.fell_back == 0) {
      EXPECT_EQ(other, 0) << round;
    }
    elsewhere += other;
  }
  EXPECT_GT(fallen, 0);
  EXPECT_GT(free, 0);
  EXPECT_GT(elsewhere, 0);  // rounds were left out
}

TEST(ContactPipeline, WhatMeetsNothingIsLeftAlone) {
  constexpr int n = 17;
  const BorderMates none;
  const CollidingCloth cloth_properties = statistics(none, n);
  Obstacles obstacles;
  obstacles.ground = -1;
  const auto collider = make_collider(PyramidOptions{}, obstacles, std::span(&cloth_properties, 1));
  TestCloth cloth(n);
  cloth.place([](int r, int c) { return Vec3d{0.1 * c, 0.02 * ((r + c) % 2), 0.1 * r}; });
  // A fall of half a metre in one step, far beyond the spacing.
  for (int s = 0; s < n * n; ++s) cloth.position.set(s, cloth.start.at(s) + Vec3f{0, -0.5F, 0});
  const Planes3 wanted = cloth.position;
  ThreadTeam team(1);
  const MovingCloth moving = cloth.moving();
  EXPECT_EQ(collider->filter(std::span(&moving, 1), step, team).moved, 0);
  for (int s = 0; s < n * n; ++s) EXPECT_EQ(cloth.position.at(s), wanted.at(s));
}

TEST(ContactPipeline, LayersOfTwoClothsStayInTheirOrder) {
  constexpr int n = 9;
  const BorderMates none;
  const SurfaceGrid grid(n, none, {});
  const std::array both{statistics(none, n), statistics(none, n)};
  const auto collider = make_collider(PyramidOptions{}, {}, both);
  TestCloth low(n), high(n);
  low.place([](int r, int c) { return Vec3d{0.1 * c, 0, 0.1 * r}; });
  high.place([](int r, int c) { return Vec3d{0.1 * c + 0.03, 0.01, 0.1 * r + 0.04}; });
  for (int s = 0; s < n * n; ++s) {
    low.position.set(s, low.start.at(s) + Vec3f{0, 0.03F, 0});
    high.position.set(s, high.start.at(s) + Vec3f{0, -0.03F, 0});
  }
  ThreadTeam team(2);
  const std::array moving{low.moving(), high.moving()};
  collider->filter(moving, step, team);
  const Primitives a(grid, low.start, low.position), b(grid, high.start, high.position);
  EXPECT_EQ(meetings(a, b, false), 0);
  // Both give way alike, so they meet about half-way.
  EXPECT_NEAR(low.position.at(4, 4).y, 0.005, 1e-3);
  EXPECT_NEAR(high.position.at(4, 4).y, 0.005, 1e-3);
}

/// A flat sheet, one sample of which is thrown past its neighbour along the sheet, where the search
/// finds no contact.
TEST(ContactPipeline, WhatTheFilterHeldBackIsAContactOfTheNextSolve) {
  constexpr int n = 5, thrown = 2 * n + 2;
  const BorderMates none;
  const CollidingCloth statistics_of = statistics(none, n);
  const auto collider = make_collider(PyramidOptions{}, {}, std::span(&statistics_of, 1));
  TestCloth cloth(n);
  const auto throw_it = [&] {
    cloth.place([](int r, int c) { return Vec3d{0.1 * c, 0.002 * (r % 2), 0.1 * r}; });
    cloth.position.set(thrown, cloth.start.at(thrown) + Vec3f{0.25F, 0, 0.02F});
  };
  ThreadTeam team(2);
  throw_it();
  const std::array moving{cloth.moving()};
  collider->detect(moving, step, team);
  ASSERT_TRUE(collider->contacts(0).empty());
  ASSERT_GT(collider->filter(moving, step, team).moved, 0);
  EXPECT_TRUE(collider->learn_struck(moving, step));
  EXPECT_FALSE(collider->learn_struck(moving, step)) << "all of them are known";
  collider->rollback();
  throw_it();
  collider->detect(moving, step, team);
  ASSERT_FALSE(collider->contacts(0).empty());
  for (const Contact& contact : collider->contacts(0)) {
    EXPECT_LE(depth_of(contact, cloth.start), 1e-7) << "adds no energy";
    EXPECT_LE(contact.offset, static_cast<float>(statistics_of.self_thickness));
    EXPECT_GT(contact.stiffness, 0);
  }
  collider->commit();
  collider->detect(moving, step, team);
  EXPECT_TRUE(collider->contacts(0).empty()) << "they are of one step";
}

/// Two flat sheets near each other, whose other proposals differ at one corner.
TEST(ContactPipeline, FoundAgainAreContactsOfWhatEndsElsewhereAlone) {
  constexpr int n = 17;
  const BorderMates none;
  const CollidingCloth each = statistics(none, n);
  const std::array properties{each, each};
  const auto collider = make_collider(PyramidOptions{}, {}, properties);
  TestCloth low(n), high(n);
  low.place([](int r, int c) { return Vec3d{0.1 * c, 0, 0.1 * r}; });
  high.place([](int r, int c) { return Vec3d{0.03 + 0.1 * c, 0.007, 0.02 + 0.1 * r}; });
  ThreadTeam team(2);
  const std::array moving{low.moving(), high.moving()};
  collider->share_contacts(true);
  const auto shared = [&] {
    const std::span<const SharedContact> found = collider->shared_contacts();
    return std::vector<SharedContact>(found.begin(), found.end());
  };
  const auto among = [](const SharedContact& one, const std::vector<SharedContact>& all) {
    return std::any_of(all.begin(), all.end(), [&](const SharedContact& other) {
      return one.contact.samples == other.contact.samples &&
             one.contact.normal == other.contact.normal;
    });
  };
  collider->detect(moving, step, team);
  EXPECT_TRUE(shared().empty()) << "it stays farther away than the contact margin";
  high.position.set(0, high.start.at(0) - Vec3f{0, 0.004F, 0});
  collider->detect_again(moving, step, team);
  const std::vector<SharedContact> at_corner = shared();
  ASSERT_FALSE(at_corner.empty());
  for (const SharedContact& one : at_corner)
    for (std::size_t k = 0; k < 4; ++k)
      if (one.contact.weights[k] != 0) {
        EXPECT_LT(one.contact.samples[k] / n, 9);
        EXPECT_LT(one.contact.samples[k] % n, 9);
      }
  // What a detection finds that knows nothing of the one before.
  collider->detect(moving, step, team);
  EXPECT_EQ(shared().size(), at_corner.size());
  for (const SharedContact& one : shared()) EXPECT_TRUE(among(one, at_corner));
  // Within a quarter of the gap contacts stay, where a search would drop them.
  high.position.set(0, high.start.at(0) - Vec3f{0, 0.0035F, 0});
  collider->detect_again(moving, step, team);
  EXPECT_EQ(shared().size(), at_corner.size());
  high.position.set(0, high.start.at(0));
  collider->detect_again(moving, step, team);
  EXPECT_TRUE(shared().empty());
}

TEST(ContactPipeline, PinsAreStoppedToo) {
  constexpr int n = 5;
  const BorderMates none;
  const CollidingCloth cloth_properties = statistics(none, n);
  Obstacles obstacles;
  obstacles.ground = 0;
  const auto collider = make_collider(PyramidOptions{}, obstacles, std::span(&cloth_properties, 1));
  TestCloth cloth(n);
  cloth.place([](int r, int c) { return Vec3d{0.1 * c, 0.01, 0.1 * r}; });
  cloth.inverse_mass(2, 2) = 0;
  cloth.position.set(2, 2, {0.2F, -0.3F, 0.2F});
  ThreadTeam team(1);
  const MovingCloth moving = cloth.moving();
  collider->filter(std::span(&moving, 1), step, team);
  EXPECT_GT(cloth.position.at(2, 2).y, 0);
}

TEST(ContactPipeline, TeamsOfAnySizeGiveTheSameBits) {
  constexpr int n = 17;
  const BorderMates none;
  const CollidingCloth cloth_properties = statistics(none, n);
  Obstacles obstacles;
  obstacles.bodies.push_back(octahedral_sphere(17, 0.25, {0.8, 0, 0.4}));
  const auto run = [&](int threads) {
    const auto collider =
        make_collider(PyramidOptions{}, obstacles, std::span(&cloth_properties, 1));
    TestCloth cloth(n);
    Random random(5);
    throw_about(cloth, random, 0.1);
    ThreadTeam team(threads);
    const MovingCloth moving = cloth.moving();
    collider->detect(std::span(&moving, 1), step, team);
    std::vector<float> numbers;
    for (const Contact& contact : collider->contacts(0)) numbers.push_back(contact.offset);
    collider->filter(std::span(&moving, 1), step, team);
    for (int s = 0; s < n * n; ++s)
      for (const float x : {cloth.position.at(s).x, cloth.velocity.at(s).y}) numbers.push_back(x);
    return numbers;
  };
  const std::vector<float> one = run(1);
  EXPECT_GT(one.size(), 2U * n * n + 10);
  for (const int threads : {2, 3, 7}) EXPECT_EQ(run(threads), one);
}

}  // namespace
}  // namespace weft::contact_pipeline_test
