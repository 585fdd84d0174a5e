#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "weft/core/random.h"
#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/mesh/topology.h"

namespace weft {
namespace {

GeometryImage random_image(int n, std::vector<MateInterval> intervals, std::uint64_t seed) {
  GeometryImage image;
  image.cube = Planes3(n);
  image.mates = BorderMates(n, std::move(intervals));
  Random random(seed);
  const auto number = [&] { return static_cast<float>(random.uniform()); };
  for (int sample = 0; sample < n * n; ++sample)
    image.cube.set(sample, {number(), number(), number()});
  for (int k = 0; k < image.mates.class_count(); ++k)
    for (const int sample : image.mates.mates(k))
      image.cube.set(sample, image.cube.at(image.mates.mates(k)[0]));
  return image;
}

TopologyCounts counts_of(const RebuiltMesh& rebuilt) { return test::topology_of(rebuilt.mesh); }

// The edges between neighbouring border samples, mated ones once, as pairs of points; and which of
// them have no mate.
struct BorderEdges {
  std::vector<std::array<int, 2>> all, open;
};

BorderEdges border_edges(const BorderMates& mates) {
  const int n = mates.size();
  const int around = 4 * (n - 1);
  std::vector<int> uses(static_cast<std::size_t>(around), 0);  // 1: first of a pair, 2: its mate
  for (const MateInterval& run : mates.intervals())
    for (int k = 0; k < run.count; ++k) {
      uses[(run.first + k) % around] = 1;
      uses[(run.mate + around - 1 - k) % around] = 2;
    }
  BorderEdges edges;
  for (int t = 0; t < around; ++t) {
    const std::array<int, 2> ends{mates.representative(border_sample(n, t)),
                                  mates.representative(border_sample(n, (t + 1) % around))};
    if (uses[t] != 2) edges.all.push_back({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
    if (uses[t] == 0) edges.open.push_back(ends);
  }
  return edges;
}

// What every laid-out border promises: no edge joins a point with itself, no two edges the same
// points.
bool is_simple(const BorderMates& mates) {
  std::set<std::array<int, 2>> seen;
  const BorderEdges edges = border_edges(mates);
  return std::ranges::all_of(
      edges.all, [&](const auto& ends) { return ends[0] != ends[1] && seen.insert(ends).second; });
}

// V - E + F of the square with its border joined, as quads.
int euler_of_quads(const BorderMates& mates) {
  const int n = mates.size();
  std::set<int> points;
  for (int sample = 0; sample < n * n; ++sample) points.insert(mates.representative(sample));
  const int inner_edges = 2 * (n - 1) * (n - 2);
  const int edges = inner_edges + static_cast<int>(border_edges(mates).all.size());
  return static_cast<int>(points.size()) - edges + (n - 1) * (n - 1);
}

int loops_of(const BorderMates& mates) {
  std::map<int, int> next;
  for (const auto& [from, to] : border_edges(mates).open) next[from] = to;
  int loops = 0;
  while (!next.empty()) {
    ++loops;
    for (auto at = next.begin(); at != next.end();) {
      const int to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  }
  return loops;
}

// A random way to divide a border into runs and to join pairs of them.
std::vector<MateInterval> random_intervals(int n, Random& random) {
  const int around = 4 * (n - 1);
  std::vector<int> free(static_cast<std::size_t>(around), 1);
  std::vector<MateInterval> intervals;
  const int runs = 1 + random.index(6);
  for (int k = 0; k < 40 && static_cast<int>(intervals.size()) < runs; ++k) {
    const int count = 1 + random.index(random.index(2) == 0 ? 3 : around / 2);
    const MateInterval run{random.index(around), random.index(around), count};
    std::vector<int> taken = free;
    bool fits = true;
    const auto take = [&](int edge) { fits = fits && taken[edge % around]-- == 1; };
    for (int i = 0; i < count; ++i) {
      take(run.first + i);
      take(run.mate + around - 1 - i);
    }
    if (!fits) continue;
    free = taken;
    intervals.push_back(run);
  }
  return intervals;
}

TEST(Rebuild, SheetKeepsItsBorder) {
  const TopologyCounts counts = counts_of(rebuild_mesh(random_image(9, {}, 1)));
  EXPECT_EQ(counts.vertices, 81);
  EXPECT_EQ(counts.triangles, 128);
  EXPECT_EQ(counts.euler, 1);
  EXPECT_EQ(counts.boundaries, 1);
}

TEST(Rebuild, TorusIsClosed) {
  const TopologyCounts counts =
      counts_of(rebuild_mesh(random_image(5, {{0, 12, 4}, {4, 16, 4}}, 1)));
  EXPECT_EQ(counts.vertices, 16);
  EXPECT_EQ(counts.triangles, 32);
  EXPECT_EQ(counts.euler, 0);
  EXPECT_EQ(counts.boundaries, 0);
}

TEST(Rebuild, FoldedCornerQuadIsLeftOut) {
  // A sphere cut along one curve; both tips are corners.
  const RebuiltMesh rebuilt = rebuild_mesh(random_image(9, {{0, 0, 16}}, 1));
  const TopologyCounts counts = counts_of(rebuilt);
  EXPECT_EQ(counts.triangles, 2 * (64 - 2));
  EXPECT_EQ(counts.euler, 2);
  EXPECT_EQ(counts.boundaries, 0);
  EXPECT_EQ(rebuilt.vertex_of[0], rebuilt.vertex_of[1]);
  EXPECT_EQ(rebuilt.vertex_of[80], rebuilt.vertex_of[79]);
}

TEST(Rebuild, TipInTheMiddleOfASideKeepsTheSphere) {
  for (int tip = 0; tip < 16; ++tip) {
    const int around = 32;
    const TopologyCounts counts =
        counts_of(rebuild_mesh(random_image(9, {{tip, tip, around / 2}}, tip)));
    EXPECT_EQ(counts.euler, 2) << tip;
    EXPECT_EQ(counts.boundaries, 0) << tip;
  }
}

TEST(Rebuild, AnyWayToJoinTheBorderKeepsItsTopology) {
  Random random(7);
  int tried = 0;
  for (int round = 0; round < 20000; ++round) {
    const int n = 5 + random.index(4);
    const GeometryImage image = random_image(n, random_intervals(n, random), round);
    if (!is_simple(image.mates)) continue;
    ++tried;
    TopologyCounts counts;
    ASSERT_NO_THROW(counts = counts_of(rebuild_mesh(image))) << "round " << round;
    ASSERT_EQ(counts.euler, euler_of_quads(image.mates)) << "round " << round;
    ASSERT_EQ(counts.boundaries, loops_of(image.mates)) << "round " << round;
    ASSERT_EQ(counts.components, 1) << "round " << round;
  }
  EXPECT_GT(tried, 1000);
}

TEST(Rebuild, GridTrianglesAreTheRebuiltOnes) {
  const GeometryImage image = random_image(9, {{0, 0, 16}}, 3);
  const RebuiltMesh rebuilt = rebuild_mesh(image);
  const std::vector<Triangle> grid = grid_triangles(image);
  ASSERT_EQ(grid.size(), rebuilt.mesh.triangles.size());
  for (std::size_t t = 0; t < grid.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int vertex = rebuilt.mesh.triangles[t][k];
      EXPECT_EQ(rebuilt.vertex_of[grid[t][k]], vertex);
      EXPECT_EQ(rebuilt.sample_of[vertex], image.mates.representative(grid[t][k]));
      EXPECT_EQ(rebuilt.mesh.positions[vertex], image.world.to_world(image.cube.at(grid[t][k])));
    }
}

TEST(Rebuild, QuadsInsideAreSplitAlongTheShorterDiagonal) {
  const int n = 9;
  const GeometryImage image = random_image(n, {}, 5);
  const auto distance = [&](int a, int b) { return length(image.cube.at(a) - image.cube.at(b)); };
  for (const Triangle& t : grid_triangles(image)) {
    // The diagonal is the side whose ends differ in both row and column.
    for (int k = 0; k < 3; ++k) {
      const int a = t[k];
      const int b = t[(k + 1) % 3];
      const bool inside = std::min({a / n, b / n, a % n, b % n}) > 0 &&
                          std::max({a / n, b / n, a % n, b % n}) < n - 1;
      if (a / n == b / n || a % n == b % n || !inside) continue;
      EXPECT_LE(distance(a, b), distance(a / n * n + b % n, b / n * n + a % n));
    }
  }
}

TEST(Rebuild, RisingQuadsAreThoseOfItsTriangles) {
  const int n = 9;
  const GeometryImage image = random_image(n, {{8, 0, 8}}, 3);
  const RebuiltMesh rebuilt = rebuild_mesh(image);
  std::set<std::set<int>> edges;
  for (const Triangle& t : rebuilt.mesh.triangles)
    for (int k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
  const std::vector<char> rising = rising_quads(image);
  ASSERT_EQ(rising.size(), (n - 1) * (n - 1));
  for (int row = 1; row < n - 2; ++row)
    for (int col = 1; col < n - 2; ++col) {
      const auto vertex = [&](int r, int c) { return rebuilt.vertex_of[r * n + c]; };
      const bool rises = rising[row * (n - 1) + col] != 0;
      EXPECT_EQ(edges.count({vertex(row, col), vertex(row + 1, col + 1)}), rises ? 1 : 0);
      EXPECT_EQ(edges.count({vertex(row, col + 1), vertex(row + 1, col)}), rises ? 0 : 1);
    }
}

TEST(Rebuild, TrianglesTurnLeftInTheSquare) {
  const int n = 5;
  for (const Triangle& t : grid_triangles(random_image(n, {}, 5))) {
    const auto at = [&](int k) { return Vec2d{t[k] % n * 1.0, t[k] / n * 1.0}; };
    EXPECT_EQ(cross(at(1) - at(0), at(2) - at(0)), 1);
  }
}

}  // namespace
}  // namespace weft
