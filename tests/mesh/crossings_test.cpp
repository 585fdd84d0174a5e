#include "weft/mesh/crossings.h"

#include <set>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include "tests/mesh/small_meshes.h"
#include "tests/support/random_points.h"
#include "weft/shapes.h"

namespace weft {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using ExactVec = Vec3<Rational>;
using ExactCorners = std::array<ExactVec, 3>;

ExactCorners exact(const Corners& t) {
  const auto convert = [](Vec3d p) {
    return ExactVec{Rational(p.x), Rational(p.y), Rational(p.z)};
  };
  return {convert(t[0]), convert(t[1]), convert(t[2])};
}

ExactVec normal_of(const ExactCorners& t) { return cross(t[1] - t[0], t[2] - t[0]); }

/// The part of a convex polygon where dot(normal, p) >= level.
std::vector<ExactVec> clip(const std::vector<ExactVec>& polygon, const ExactVec& normal,
                           const Rational& level) {
  std::vector<ExactVec> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ExactVec &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Rational at_p = dot(normal, p) - level, at_q = dot(normal, q) - level;
    if (at_p >= 0) kept.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))
      kept.push_back(p + Rational(at_p / (at_p - at_q)) * (q - p));
  }
  return kept;
}

/// Cuts the prism over triangle `t` out of a polygon.
std::vector<ExactVec> clip_by_sides(std::vector<ExactVec> polygon, const ExactCorners& t) {
  for (int k = 0; k < 3; ++k) {
    const ExactVec inwards = cross(normal_of(t), t[(k + 1) % 3] - t[k]);
    polygon = clip(polygon, inwards, dot(inwards, t[k]));
  }
  return polygon;
}

bool has_area(const std::vector<ExactVec>& polygon) {
  ExactVec sum{};
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return !(sum == ExactVec{});
}

/// The same by rational numbers and another way: the points of `a` in the plane of `b`, strictly
/// inside both.
bool brute_cross(const Corners& first, const Corners& second) {
  const ExactCorners a = exact(first), b = exact(second);
  const ExactVec na = normal_of(a), nb = normal_of(b);
  if (na == ExactVec{} || nb == ExactVec{}) return false;
  if (cross(na, nb) == ExactVec{}) {
    if (dot(nb, a[0]) != dot(nb, b[0])) return false;
    return has_area(clip_by_sides({a[0], a[1], a[2]}, b));
  }
  // Both meet the line of the planes in an interval; these are compared along it.
  const ExactVec along = cross(na, nb);
  const auto interval = [&](const ExactCorners& t, const ExactVec& normal, const Rational& level) {
    std::vector<Rational> ends;
    std::set<int> seen;
    for (int k = 0; k < 3; ++k) {
      const ExactVec &p = t[k], &q = t[(k + 1) % 3];
      const Rational at_p = dot(normal, p) - level, at_q = dot(normal, q) - level;
      seen.insert(at_p.compare(0) < 0 ? -1 : at_p.compare(0) > 0 ? 1 : 0);
      if (at_p == 0) ends.push_back(dot(along, p));
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))
        ends.push_back(dot(along, p + Rational(at_p / (at_p - at_q)) * (q - p)));
    }
    // Only a triangle on both sides has inner points on the plane.
    if (seen.count(1) == 0 || seen.count(-1) == 0) ends.clear();
    std::sort(ends.begin(), ends.end());
    return ends;
  };
  const auto i = interval(a, nb, dot(nb, b[0])), j = interval(b, na, dot(na, a[0]));
  if (i.empty() || j.empty()) return false;
  return std::max(i.front(), j.front()) < std::min(i.back(), j.back());
}

TEST(Crossings, TrianglesThatPassThroughEachOtherCrossOthersDoNot) {
  const Corners flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_TRUE(triangles_cross(flat, {{{0.2, 0.2, -1}, {0.3, 0.2, 1}, {0.2, 0.3, 1}}}));
  EXPECT_TRUE(triangles_cross(flat, {{{0.2, -1, -1}, {0.2, 5, -1}, {0.2, 0.2, 1}}}));
  EXPECT_FALSE(triangles_cross(flat, {{{0.2, 0.2, 0.1}, {0.3, 0.2, 1}, {0.2, 0.3, 1}}}));
  EXPECT_FALSE(triangles_cross(flat, {{{2, 2, -1}, {2.1, 2, 1}, {2, 2.1, 1}}}));
}

TEST(Crossings, TouchingDoesNotCountOverlapInOnePlaneDoes) {
  const Corners flat{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  EXPECT_FALSE(triangles_cross(flat, {{{1, 1, 0}, {1, 1, 1}, {2, 1, 1}}})) << "a corner inside";
  EXPECT_FALSE(triangles_cross(flat, {{{1, 1, 0}, {2, 1, 0}, {1, 1, 1}}})) << "an edge inside";
  EXPECT_FALSE(triangles_cross(flat, {{{0, 0, 0}, {4, 0, 0}, {0, -4, 0}}})) << "neighbours";
  EXPECT_TRUE(triangles_cross(flat, {{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}})) << "folded onto it";
  EXPECT_TRUE(triangles_cross(flat, flat));
  EXPECT_FALSE(triangles_cross(flat, {{{1, 1, -1}, {1, 1, 1}, {1, 1, 3}}})) << "no area";
}

TEST(Crossings, NeighboursAtACornerCrossWhenOnePassesThroughTheOther) {
  const Corners flat{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  EXPECT_TRUE(triangles_cross(flat, {{{0, 0, 0}, {2, 2, 1}, {2, 2, -1}}}));
  EXPECT_FALSE(triangles_cross(flat, {{{0, 0, 0}, {-2, -2, 1}, {-2, -2, -1}}}));
}

// Corners on a small lattice: nearly every pair is degenerate in some way.
TEST(Crossings, EqualsRationalArithmeticOnDegeneratePairs) {
  Random random(11);
  int crossing = 0;
  for (int i = 0; i < 8000; ++i) {
    const int side = 2 + i % 4;
    Corners a, b;
    for (Corners* t : {&a, &b})
      for (Vec3d& p : *t)
        p = {0.1 * random.index(side), 0.1 * random.index(side), 0.1 * random.index(side)};
    if (i % 3 == 0) b[0] = a[1];
    if (i % 6 == 0) b[2] = a[0];
    const bool truth = brute_cross(a, b);
    crossing += truth ? 1 : 0;
    ASSERT_EQ(triangles_cross(a, b), truth) << i;
    ASSERT_EQ(triangles_cross(b, a), truth) << i;
  }
  EXPECT_GT(crossing, 500);
}

TEST(Crossings, EqualsRationalArithmeticOnRandomPairs) {
  Random random(12);
  int crossing = 0;
  for (int i = 0; i < 1500; ++i) {
    Corners a, b;
    for (Corners* t : {&a, &b})
      for (Vec3d& p : *t) p = test::random_point(random);
    // Every second pair: corners of b within rounding of the plane of a.
    if (i % 2 == 0) b[0] = 0.3 * a[0] + 0.3 * a[1] + 0.4 * a[2];
    if (i % 4 == 0) b[1] = 0.5 * a[0] + 0.2 * a[1] + 0.3 * a[2];
    if (i % 8 == 0) b[2] = 0.1 * a[0] + 0.8 * a[1] + 0.1 * a[2];
    const bool truth = brute_cross(a, b);
    crossing += truth ? 1 : 0;
    ASSERT_EQ(triangles_cross(a, b), truth) << i;
  }
  EXPECT_GT(crossing, 200);
}

TriangleMesh box(Vec3d lower, Vec3d upper) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({(i & 1) != 0 ? upper.x : lower.x, (i & 2) != 0 ? upper.y : lower.y,
                              (i & 4) != 0 ? upper.z : lower.z});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

std::vector<std::array<int, 2>> self_crossings(const TriangleMesh& mesh) {
  std::vector<std::array<int, 2>> pairs;
  for_self_crossings(corners_of(mesh), Neighbours(mesh.triangles), [&](int s, int t) {
    pairs.push_back({s, t});
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// A bar along x through both faces of a cube across x, beside the faces' diagonals: each of its
// long sides is two triangles, and each of these passes through one triangle of each face.
TEST(Crossings, BarThroughABoxIsCountedByHand) {
  const TriangleMesh cube = box({0, 0, 0}, {4, 4, 4});
  EXPECT_TRUE(self_crossings(cube).empty());
  const TriangleMesh bar = box({-1, 3, 1}, {5, 3.5, 1.5});
  EXPECT_EQ(self_crossings(test::together(cube, bar)).size(), 2U * 4 * 2);
  const CrossingSurface box_surface(corners_of(cube)), bar_surface(corners_of(bar));
  EXPECT_EQ(box_surface.count_crossings(bar_surface), 16);
  EXPECT_EQ(bar_surface.count_crossings(box_surface), 16);
}

TEST(Crossings, BuiltInShapesHaveNone) {
  for (const char* name : {"sphere", "torus"})
    EXPECT_TRUE(self_crossings(make_shape(name)).empty()) << name;
}

TEST(Crossings, TreeFindsWhatTestingEveryPairFinds) {
  Random random(5);
  TriangleMesh mesh;
  for (int t = 0; t < 300; ++t) {
    const Vec3d centre = test::random_point(random);
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(centre + test::random_point(random, 0.3));
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  // Twins, and one without area.
  mesh.triangles.push_back(mesh.triangles[7]);
  mesh.triangles.push_back({0, 0, 5});
  const std::vector<Corners> corners = corners_of(mesh);
  std::vector<std::array<int, 2>> brute;
  for (int s = 0; s < static_cast<int>(corners.size()); ++s)
    for (int t = s + 1; t < static_cast<int>(corners.size()); ++t)
      if (triangles_cross(corners[s], corners[t])) brute.push_back({s, t});
  EXPECT_GT(brute.size(), 50U);
  EXPECT_EQ(self_crossings(mesh), brute);
}

/// A strip of 5 x 3 vertices: rows at 0 to 4 along x, across them what `across` says.
TriangleMesh strip(const std::array<Vec3d, 3>& across, double from = 0) {
  TriangleMesh mesh;
  for (int r = 0; r < 5; ++r)
    for (int c = 0; c < 3; ++c) {
      mesh.positions.push_back(across[c] + Vec3d{from + r, 0, 0});
      if (r == 0 || c == 0) continue;
      const int v = 3 * r + c;
      mesh.triangles.push_back({v - 4, v - 3, v});
      mesh.triangles.push_back({v - 4, v, v - 1});
    }
  return mesh;
}

std::int64_t crossings_of(const TriangleMesh& a, const TriangleMesh& b) {
  const CrossingSurface one(corners_of(a), Neighbours(a.triangles));
  const CrossingSurface two(corners_of(b), Neighbours(b.triangles));
  const std::int64_t count = one.count_crossings(two);
  EXPECT_EQ(two.count_crossings(one), count);
  EXPECT_EQ(self_crossings(test::together(a, b)).size(), static_cast<std::size_t>(count));
  return count;
}

const TriangleMesh flat_strip = strip({{{0, -1, 0}, {0, 0, 0}, {0, 1, 0}}});

TEST(Crossings, SurfacesThatPassThroughEachOtherAlongEdgesCross) {
  const std::array<Vec3d, 3> upright{{{0, 0, -1}, {0, 0, 0}, {0, 0, 1}}};
  EXPECT_EQ(crossings_of(flat_strip, strip(upright)), 4) << "edge on edge";
  EXPECT_EQ(crossings_of(flat_strip, strip(upright, 0.5)), 7) << "in halves";
  EXPECT_EQ(crossings_of(flat_strip, strip(upright, 4)), 0) << "they touch in a point";
  EXPECT_EQ(crossings_of(flat_strip, strip({{{0, 0.25, -1}, {0, 0.25, 0}, {0, 0.25, 1}}})), 8)
      << "each of 4 edges inside of two triangles";
  EXPECT_EQ(crossings_of(flat_strip, strip({{{0, -1, -1}, {0, 0, 0}, {0, 2, 1}}})), 4)
      << "both sides, bent";
}

TEST(Crossings, SurfacesThatTouchAlongEdgesDoNotCross) {
  EXPECT_EQ(crossings_of(flat_strip, strip({{{0, -1, 1}, {0, 0, 0}, {0, 1, 1}}})), 0) << "a keel";
  EXPECT_EQ(crossings_of(flat_strip, strip({{{0, 0.2, 1}, {0, 0, 0}, {0, 0.3, 1}}})), 0);
  EXPECT_EQ(crossings_of(flat_strip, strip({{{0, 0.25, 1}, {0, 0.25, 0}, {0, 0.5, 1}}})), 0);
  EXPECT_EQ(crossings_of(flat_strip, strip({{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}})), 0) << "a border";
  EXPECT_EQ(crossings_of(strip({{{0, -1, 1}, {0, 0, 0}, {0, 1, 1}}}),
                         strip({{{0, -1, 3}, {0, 0, 0}, {0, 1, 3}}})),
            0)
      << "one keel in another";
}

// Two triangles on an edge each, corners on a small lattice: what crosses along edges does after
// any small displacement, too.
TEST(Crossings, CrossingAlongEdgesOutlastsSmallDisplacements) {
  Random random(21);
  int along_edges = 0;
  for (int i = 0; i < 60000; ++i) {
    TriangleMesh a, b;
    for (TriangleMesh* mesh : {&a, &b}) {
      for (int k = 0; k < 4; ++k)
        mesh->positions.push_back(
            {1.0 * random.index(3), 1.0 * random.index(3), 1.0 * random.index(3)});
      mesh->triangles = {{0, 1, 2}, {1, 0, 3}};
    }
    if (i % 2 == 0) {
      b.positions[0] = a.positions[0];
      b.positions[1] = a.positions[1];
    }
    const auto count = [&](const Neighbours& neighbours) {
      return CrossingSurface(corners_of(a), neighbours)
          .count_crossings(CrossingSurface(corners_of(b), neighbours));
    };
    if (count({}) > 0 || count(Neighbours(a.triangles)) == 0) continue;
    ++along_edges;
    for (int k = 0; k < 8; ++k) {
      const std::vector<Vec3d> there = b.positions;
      const Vec3d aside = test::random_point(random, 1e-6);
      for (Vec3d& p : b.positions) p += aside;
      ASSERT_GT(count({}), 0) << i;
      b.positions = there;
    }
  }
  EXPECT_GT(along_edges, 300);
}

}  // namespace
}  // namespace weft
