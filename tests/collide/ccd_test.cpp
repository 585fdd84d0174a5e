#include "weft/collide/ccd.h"

#include <algorithm>
#include <filesystem>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include "apps/ccd/queries.h"
#include "weft/core/random.h"

namespace weft {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using ExactVec = Vec3<Rational>;

ExactVec exact(Vec3d p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }

/// Where a point is at a time.
ExactVec at(Vec3d start, Vec3d end, const Rational& time) {
  return Rational(1 - time) * exact(start) + time * exact(end);
}

/// Exactly how far the two points that an impact names are apart, squared.
Rational squared_distance(const EdgeEdge& start, const EdgeEdge& end, const Impact& impact) {
  const Rational t(impact.time), u(impact.u), v(impact.v);
  const ExactVec first = Rational(1 - u) * at(start.first[0], end.first[0], t) +
                         u * at(start.first[1], end.first[1], t);
  const ExactVec second = Rational(1 - v) * at(start.second[0], end.second[0], t) +
                          v * at(start.second[1], end.second[1], t);
  return squared_length(first - second);
}

Rational squared_distance(const VertexFace& start, const VertexFace& end, const Impact& impact) {
  const Rational t(impact.time), u(impact.u), v(impact.v);
  const ExactVec on_face = Rational(1 - u - v) * at(start.face[0], end.face[0], t) +
                           u * at(start.face[1], end.face[1], t) +
                           v * at(start.face[2], end.face[2], t);
  return squared_length(at(start.vertex, end.vertex, t) - on_face);
}

/// By how much weights may leave 0 .. 1 by rounding.
constexpr double weight_rounding = 1e-15;
bool inside(const EdgeEdge& /*pair*/, const Impact& i) {
  return std::min(i.u, i.v) >= -weight_rounding && std::max(i.u, i.v) <= 1 + weight_rounding;
}
bool inside(const VertexFace& /*pair*/, const Impact& i) {
  return std::min(i.u, i.v) >= -weight_rounding && i.u + i.v <= 1 + weight_rounding;
}

template <class Pair>
void expect_within_tolerance(const Pair& start, const Pair& end, const Impact& impact,
                             const CcdOptions& options) {
  EXPECT_TRUE(inside(start, impact)) << impact.u << " " << impact.v;
  const Rational squared = squared_distance(start, end, impact);
  const Rational bound(options.separation + options.tolerance);
  EXPECT_LE(squared, bound * bound) << impact.distance;
  EXPECT_LE(squared, Rational(impact.distance) * Rational(impact.distance));
}

/// Multiples of 2^-20 in -1 .. 1, so that a few sums and halvings of them are exact.
Vec3d dyadic_point(Random& random) {
  const auto coordinate = [&] {
    return std::ldexp(std::floor(random.uniform() * 0x1p21), -20) - 1;
  };
  return {coordinate(), coordinate(), coordinate()};
}
double dyadic_weight(Random& random) { return std::floor(random.uniform() * 9) / 8; }

template <class Pair>
struct Motion {
  Pair start, end;
  double time = 1;  ///< when the pair touches, if not before
};

/// The vertex flies to where it meets a point of the moving face, exactly.
Motion<VertexFace> touching_vertex_face(Random& random) {
  Motion<VertexFace> motion;
  motion.time = std::ldexp(1.0, -static_cast<int>(random.uniform() * 4));
  const double u = dyadic_weight(random), v = (1 - u) * dyadic_weight(random);
  VertexFace &start = motion.start, &end = motion.end;
  start.vertex = dyadic_point(random);
  for (int k = 0; k < 3; ++k) {
    start.face[k] = dyadic_point(random);
    end.face[k] = dyadic_point(random);
  }
  const auto blend = [&](int k) {
    return (1 - motion.time) * start.face[k] + motion.time * end.face[k];
  };
  const Vec3d meeting = (1 - u - v) * blend(0) + u * blend(1) + v * blend(2);
  end.vertex = (1 / motion.time) * (meeting - (1 - motion.time) * start.vertex);
  return motion;
}

/// One end of the first edge moves such that a dyadic point of it meets one of the second.
Motion<EdgeEdge> touching_edges(Random& random) {
  Motion<EdgeEdge> motion;
  motion.time = std::ldexp(1.0, -static_cast<int>(random.uniform() * 4));
  const double u = std::ldexp(1.0, -static_cast<int>(random.uniform() * 4));
  const double v = dyadic_weight(random);
  EdgeEdge &start = motion.start, &end = motion.end;
  for (EdgeEdge* pair : {&start, &end})
    for (int k = 0; k < 2; ++k) {
      pair->first[k] = dyadic_point(random);
      pair->second[k] = dyadic_point(random);
    }
  const double t = motion.time;
  const auto blend = [t](Vec3d a, Vec3d b) { return (1 - t) * a + t * b; };
  const Vec3d meeting =
      (1 - v) * blend(start.second[0], end.second[0]) + v * blend(start.second[1], end.second[1]);
  const Vec3d other = blend(start.first[0], end.first[0]);
  const Vec3d wanted = (1 / u) * (meeting - (1 - u) * other);
  end.first[1] = (1 / t) * (wanted - (1 - t) * start.first[1]);
  return motion;
}

/// @param separation  asked for; the pair comes nearer
template <class Pair>
void expect_found(const Motion<Pair>& motion, const CcdOptions& options) {
  const auto impact = time_of_impact(motion.start, motion.end, options);
  ASSERT_TRUE(impact);
  EXPECT_LE(impact->time, motion.time);
  expect_within_tolerance(motion.start, motion.end, *impact, options);
}

TEST(Ccd, NeverMissesWhatTouchesExactly) {
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    expect_found(touching_vertex_face(random), {});
    expect_found(touching_edges(random), {});
    expect_found(touching_vertex_face(random), {.separation = 0.01, .tolerance = 1e-6});
    expect_found(touching_edges(random), {.separation = 0.01, .tolerance = 1e-6});
  }
}

TEST(Ccd, NeverMissesFlatAndVanishingPrimitives) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    Motion<VertexFace> motion = touching_vertex_face(random);
    // Everything in one plane; and triangles that are a segment or a point, at their first corner.
    const auto flatten = [](VertexFace& pair) {
      for (Vec3d* p : {&pair.vertex, &pair.face[0], &pair.face[1], &pair.face[2]}) p->y = 0.25;
    };
    flatten(motion.start);
    flatten(motion.end);
    expect_found(motion, {});
    motion = touching_vertex_face(random);
    const double t = motion.time;
    for (VertexFace* pair : {&motion.start, &motion.end})
      for (int k = i % 2 + 1; k < 3; ++k) pair->face[k] = pair->face[0];
    motion.end.vertex = (1 / t) * ((1 - t) * motion.start.face[0] + t * motion.end.face[0] -
                                   (1 - t) * motion.start.vertex);
    expect_found(motion, {});
  }
}

TEST(Ccd, StaysApartBeforeTheTimeItTells) {
  Random random(3);
  int checked = 0;
  for (int i = 0; i < 500; ++i) {
    const Motion<EdgeEdge> motion = touching_edges(random);
    const CcdOptions options{.separation = 0.02};
    const auto impact = time_of_impact(motion.start, motion.end, options);
    ASSERT_TRUE(impact);
    for (int k = 0; k < 20; ++k) {
      // A pair of points of the edges at any earlier time is no nearer than the separation.
      const Impact earlier{
          .time = impact->time * random.uniform(), .u = random.uniform(), .v = random.uniform()};
      if (earlier.time >= impact->time) continue;
      EXPECT_GE(squared_distance(motion.start, motion.end, earlier), Rational(0.02 * 0.02));
      ++checked;
    }
  }
  EXPECT_GT(checked, 5000);
}

TEST(Ccd, VertexFallsOntoAFaceAtTheKnownTime) {
  const std::array<Vec3d, 3> face{{{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}}};
  const VertexFace start{{0, 1, 0}, face}, end{{0, -1, 0}, face};
  const auto impact = time_of_impact(start, end, {.separation = 0.25});
  ASSERT_TRUE(impact);
  EXPECT_NEAR(impact->time, 0.375, 1e-12);
  EXPECT_LE(impact->steps, 3);
  const VertexFace beside{{1.5, 1, 0}, face}, beside_end{{1.5, -1, 0}, face};
  EXPECT_FALSE(time_of_impact(beside, beside_end));
}

TEST(Ccd, ParallelEdgesSlidePastEachOther) {
  const double gap = 1e-9;
  const EdgeEdge start{{{{-1, gap, 0}, {1, gap, 0}}}, {{{-3, 0, 0}, {-1, 0, 0}}}};
  const EdgeEdge end{start.first, {{{1, 0, 0}, {3, 0, 0}}}};
  EXPECT_FALSE(time_of_impact(start, end));
  const auto impact = time_of_impact(start, end, {.separation = gap});
  ASSERT_TRUE(impact);
  EXPECT_LE(impact->distance, 2 * gap);
}

TEST(Ccd, ReportsWhatRoundedInputMayHide) {
  const std::array<Vec3d, 3> face{{{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}}};
  const VertexFace start{{0, 1, 0}, face}, end{{0, 1e-7, 0}, face};
  EXPECT_FALSE(time_of_impact(start, end));
  EXPECT_TRUE(time_of_impact(start, end, {.input_error = 1e-7}));
}

TEST(Ccd, CountsAsCollidingWhereTheStepsRunOut) {
  Random random(4);
  const Motion<EdgeEdge> motion = touching_edges(random);
  const auto impact = time_of_impact(motion.start, motion.end, {.max_steps = 1});
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->time, 0);
  EXPECT_GT(impact->distance, 1e-3);
}

/// Queries with exact answers that lie beside the project.
TEST(Ccd, MissesNothingOfTheSharedQueriesAndErrsWithinTheTolerance) {
  const std::filesystem::path folder = WEFT_SHARED_DIR "/ccd";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  const CcdOptions options;
  int files = 0, positives = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".csv") continue;
    ++files;
    const ccd::QueryFile file = ccd::read_queries(entry.path());
    for (const ccd::Query& query : file.queries) {
      const auto impact = ccd::answer(query, file.kind, options);
      positives += query.collides ? 1 : 0;
      EXPECT_EQ(query.input_error, 0) << "the bound below is for exact input";
      EXPECT_TRUE(impact || !query.collides) << entry.path();
      if (!impact) continue;
      const auto& p = query.points;
      if (file.kind == ccd::QueryKind::edge_edge)
        expect_within_tolerance(EdgeEdge{{p[0], p[1]}, {p[2], p[3]}},
                                EdgeEdge{{p[4], p[5]}, {p[6], p[7]}}, *impact, options);
      else
        expect_within_tolerance(VertexFace{p[0], {p[1], p[2], p[3]}},
                                VertexFace{p[4], {p[5], p[6], p[7]}}, *impact, options);
    }
  }
  EXPECT_EQ(files, 22);
  EXPECT_EQ(positives, 225);
}

}  // namespace
}  // namespace weft
