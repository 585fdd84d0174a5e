#include <algorithm>
#include <map>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

#include "tests/param/layout_cases.h"
#include "weft/core/random.h"
#include "weft/param/border_layout.h"

namespace weft {
namespace {

using test::Case;
using test::layout_cases;

/// Row-major index of the sample at a border position, any whole number.
int border_sample_at(int n, int position) {
  const int side = n - 1;
  const Vec2d p = border_point(n, (position % (4 * side) + 4 * side) % (4 * side));
  return static_cast<int>(p.y) * n + static_cast<int>(p.x);
}

/// [n * n] the least sample that is the same point of the surface.
std::vector<int> joined_samples(const CutDisk& cut, const BorderLayout& layout) {
  const int n = layout.size.rows;
  std::vector<int> same(n * n);
  std::iota(same.begin(), same.end(), 0);
  const auto root = [&](int s) {
    while (same[s] != s) s = same[s];
    return s;
  };
  for (std::size_t p = 0; p < cut.paths.size(); ++p) {
    const int mate = cut.paths[p].mate;
    const int intervals = layout.intervals[p];
    for (int j = 0; mate >= 0 && j <= intervals; ++j) {
      const int a = root(border_sample_at(n, layout.first[p] + j));
      const int b = root(border_sample_at(n, layout.first[mate] + intervals - j));
      same[std::max(a, b)] = std::min(a, b);
    }
  }
  for (int& s : same) s = root(s);
  return same;
}

/// The grid with its mates joined, each quad split along one diagonal, triangles with a repeated
/// point dropped.
class JoinedGrid {
 public:
  JoinedGrid(const CutDisk& cut, const BorderLayout& layout, Random& random)
      : n_(layout.size.rows), points_(joined_samples(cut, layout)), rising_((n_ - 1) * (n_ - 1)) {
    for (char& rising : rising_) rising = static_cast<char>(random.index(2));
  }

  [[nodiscard]] std::vector<Triangle> triangles() const {
    std::vector<Triangle> all;
    for (int quad = 0; quad < static_cast<int>(rising_.size()); ++quad)
      for (const Triangle& t : quad_triangles(quad)) all.push_back(t);
    return all;
  }

  /// Turns diagonals at the border, at random, until no two triangles run along two points in the
  /// same direction. @return false when a thousand turns were not enough
  bool make_simplicial(Random& random) {
    for (int turn = 0; turn < 1000; ++turn) {
      const std::vector<int> bad = quads_on_double_edges();
      if (bad.empty()) return true;
      rising_[bad[random.index(static_cast<int>(bad.size()))]] ^= 1;
    }
    return false;
  }

 private:
  [[nodiscard]] std::vector<Triangle> quad_triangles(int quad) const {
    const int a = quad / (n_ - 1) * n_ + quad % (n_ - 1);
    const auto point = [&](int row, int col) { return points_[a + row * n_ + col]; };
    std::vector<Triangle> both{{point(0, 0), point(0, 1), point(1, 1)},
                               {point(0, 0), point(1, 1), point(1, 0)}};
    if (!rising_[quad])
      both = {{point(0, 0), point(0, 1), point(1, 0)}, {point(0, 1), point(1, 1), point(1, 0)}};
    std::erase_if(both,
                  [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    return both;
  }

  [[nodiscard]] std::vector<int> quads_on_double_edges() const {
    std::map<std::pair<int, int>, std::vector<int>> runs;
    for (int quad = 0; quad < static_cast<int>(rising_.size()); ++quad)
      for (const Triangle& t : quad_triangles(quad))
        for (int k = 0; k < 3; ++k) runs[{t[k], t[(k + 1) % 3]}].push_back(quad);
    std::vector<int> bad;
    for (const auto& [ends, quads] : runs)
      if (quads.size() > 1) bad.insert(bad.end(), quads.begin(), quads.end());
    return bad;
  }

  int n_;
  std::vector<int> points_;
  std::vector<char> rising_;
};

// The promise that all of stage 5 serves: joined, the samples are the input's surface.
TEST(LayOutBorder, JoinedGridHasTheTopologyOfTheSurfaceAtEverySizeAndRotation) {
  Random random(11);
  for (const Case& c : layout_cases()) {
    const int min = min_size(c.cut);
    for (const int n : {min, min + 1, min + 4})
      for (int rotation = 0; rotation < 4 * (n - 1); ++rotation) {
        SCOPED_TRACE(c.name + ", n " + std::to_string(n) + ", rotation " +
                     std::to_string(rotation));
        JoinedGrid grid(c.cut, lay_out_border(c.cut, {n, rotation}), random);
        ASSERT_TRUE(grid.make_simplicial(random));
        const TopologyCounts counts = count_topology(n * n, grid.triangles());
        EXPECT_EQ(counts.components, 1);
        EXPECT_EQ(counts.euler, c.surface.euler);
        EXPECT_EQ(counts.boundaries, c.surface.boundaries);
      }
  }
}

}  // namespace
}  // namespace weft
