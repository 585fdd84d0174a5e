#include "weft/mesh/distance.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random_points.h"
#include "weft/core/random.h"
#include "weft/shapes.h"

namespace weft {
namespace {

using test::random_point;

/// Unconnected triangles of all sizes, some of them slivers.
TriangleMesh random_soup(int count, std::uint64_t seed) {
  Random random(seed);
  TriangleMesh mesh;
  for (int t = 0; t < count; ++t) {
    const Vec3d a = random_point(random);
    const double size = random.uniform() * random.uniform();
    const Vec3d edge = size * random_point(random);
    const Vec3d c = t % 7 == 0 ? a + 0.5 * edge : a + size * random_point(random);
    const int first = static_cast<int>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, a + edge, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// A square of side 1 at height y, as two triangles.
TriangleMesh square_at(double y) {
  return {.positions = {{0, y, 0}, {1, y, 0}, {1, y, 1}, {0, y, 1}},
          .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

TEST(ClosestOnTriangle, HasAnalyticAnswersOverFaceEdgesAndCorners) {
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  const auto near = [&](Vec3d p, Vec3d wanted) {
    return length(closest_on_triangle(p, a, b, c) - wanted) < 1e-15;
  };
  EXPECT_TRUE(near({0.25, 0.25, 3}, {0.25, 0.25, 0}));
  EXPECT_TRUE(near({0.5, -2, 1}, {0.5, 0, 0}));
  EXPECT_TRUE(near({-2, 0.75, -1}, {0, 0.75, 0}));
  EXPECT_TRUE(near({1, 1, 5}, {0.5, 0.5, 0}));
  EXPECT_TRUE(near({-1, -1, 0}, a));
  EXPECT_TRUE(near({3, -0.5, 0}, b));
  EXPECT_TRUE(near({-0.5, 3, 2}, c));
}

TEST(ClosestOnTriangle, TakesATriangleWithoutAreaForItsLongestEdge) {
  const Vec3d found = closest_on_triangle({1.5, 1, 0}, {0, 0, 0}, {2, 0, 0}, {1, 0, 0});
  EXPECT_NEAR(length(found - Vec3d{1.5, 0, 0}), 0, 1e-15);
  const Vec3d point{1, 2, 3};
  EXPECT_EQ(closest_on_triangle({}, point, point, point), point);
}

TEST(ClosestPointQuery, AgreesWithBruteForce) {
  const TriangleMesh mesh = random_soup(300, 3);
  const ClosestPointQuery query(mesh);
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const Vec3d point = 2.0 * random_point(random);
    ClosestPoint best;
    for (int t = 0; t < 300; ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const Vec3d p =
          closest_on_triangle(point, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
      if (squared_length(point - p) < best.squared_distance)
        best = {p, t, squared_length(point - p)};
    }
    const ClosestPoint found = query.closest(point);
    EXPECT_EQ(found.squared_distance, best.squared_distance);
    EXPECT_EQ(found.triangle, best.triangle);
    EXPECT_EQ(found.position, best.position);
  }
}

TEST(ClosestPointQuery, HintChangesNoAnswer) {
  const TriangleMesh mesh = make_shape("torus");
  const ClosestPointQuery query(mesh);
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    // Vertices are shared by six triangles: all of them are equally close.
    const Vec3d point = mesh.positions[random.index(static_cast<int>(mesh.positions.size()))];
    const ClosestPoint plain = query.closest(point);
    const ClosestPoint hinted =
        query.closest(point, random.index(static_cast<int>(mesh.triangles.size())));
    EXPECT_EQ(plain.triangle, hinted.triangle);
    EXPECT_EQ(plain.position, hinted.position);
  }
}

TEST(SampleSurface, CountsFollowAreas) {
  TriangleMesh mesh = square_at(0);
  mesh.positions.insert(mesh.positions.end(), {{5, 0, 0}, {8, 0, 0}, {5, 0, 2}});  // area 3
  mesh.triangles.push_back({4, 5, 6});
  const std::vector<Vec3d> samples = sample_surface(mesh, 1000, 1);
  ASSERT_EQ(samples.size(), 1000U);
  int in_first = 0;
  Vec3d mean_of_last;
  for (const Vec3d p : samples) {
    if (p.x <= 1) {
      ++in_first;
    } else {
      mean_of_last += (1.0 / 750) * p;
    }
  }
  EXPECT_EQ(in_first, 250);
  EXPECT_NEAR(mean_of_last.x, 6, 0.1);  // the centroid, to four standard errors
  EXPECT_NEAR(mean_of_last.z, 2.0 / 3, 0.07);
}

TEST(SurfaceDistance, OfParallelSquaresIsTheirGap) {
  const SurfaceDistance found = surface_distance(square_at(0), square_at(0.25));
  EXPECT_NEAR(found.rms, 0.25, 1e-14);
  EXPECT_NEAR(found.hausdorff, 0.25, 1e-14);
}

TEST(SurfaceDistance, OfASurfaceFromItselfIsRounding) {
  const TriangleMesh mesh = make_shape("sphere");
  const SurfaceDistance found = surface_distance(mesh, mesh, {.samples = 2000});
  EXPECT_LT(found.hausdorff, 1e-15);
}

TEST(SurfaceDistance, LooksBothWays) {
  // One triangle of the square is missing in `half`: only the samples of `whole` can see it.
  const TriangleMesh whole = square_at(0);
  TriangleMesh half = whole;
  half.triangles.pop_back();
  const SurfaceDistance there = surface_distance(whole, half), back = surface_distance(half, whole);
  EXPECT_NEAR(there.hausdorff, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(back.hausdorff, std::sqrt(0.5), 1e-15);
  // Half of the area is missing and lies uniformly over heights up to h = sqrt(1/2) of its
  // triangle: mean = 1/2 * h / 3, mean square = 1/2 * h^2 / 6.
  EXPECT_NEAR(there.from_first.mean, std::sqrt(0.5) / 6, 0.002);
  EXPECT_NEAR(there.rms, std::sqrt(1.0 / 24), 0.002);
  EXPECT_EQ(there.from_first.rms, there.rms);
  EXPECT_NEAR(there.from_second.largest, 0, 1e-9);
  EXPECT_EQ(back.from_second.largest, back.hausdorff);
}

TEST(SurfaceDistance, SeesTipsThatHoldNextToNoArea) {
  TriangleMesh spiked = square_at(0);
  spiked.positions.push_back({0.5, 3, 0});
  spiked.positions.push_back({0.5 + 1e-6, 0, 0});
  spiked.positions.push_back({0.5, 0, 1e-6});
  spiked.positions.push_back({7, 7, 7});  // no triangle's corner
  spiked.triangles.push_back({4, 5, 6});
  const SurfaceDistance found = surface_distance(spiked, square_at(0), {.samples = 100});
  EXPECT_NEAR(found.hausdorff, 3, 1e-15);
  EXPECT_LT(found.rms, 1e-15);
}

TEST(SurfaceDistance, CanBeStoppedOnTheWay) {
  struct Stopped {};
  struct Impatient : Progress {
    int told = 0;
    void update(std::string_view /*stage*/, double /*fraction*/) override {
      if (++told == 4) throw Stopped();
    }
  } impatient;
  const TriangleMesh mesh = make_shape("sphere");
  EXPECT_THROW(surface_distance(mesh, mesh, {.threads = 2, .progress = &impatient}), Stopped);
}

TEST(SurfaceDistance, HasTheSameBitsOnAnyNumberOfThreads) {
  const TriangleMesh a = make_shape("sphere"), b = make_shape("torus");
  const SurfaceDistance one = surface_distance(a, b, {.samples = 3000, .threads = 1});
  for (const int threads : {2, 3, 7}) {
    const SurfaceDistance many = surface_distance(a, b, {.samples = 3000, .threads = threads});
    EXPECT_EQ(one.rms, many.rms);
    EXPECT_EQ(one.hausdorff, many.hausdorff);
  }
}

}  // namespace
}  // namespace weft
