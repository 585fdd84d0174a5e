#include "weft/collide/intersections.h"

#include <gtest/gtest.h>

#include "weft/core/random.h"
#include "weft/mesh/crossings.h"

namespace weft {
namespace {

TEST(Intersections, CountEqualsTestingEveryPair) {
  const int n = 21;
  Random random(7);
  Planes3 a(n), b(n);
  std::vector<Triangle> triangles;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const auto noise = [&] { return 0.05 * random.uniform(); };
      a.set(r, c, vec_cast<float>(Vec3d{0.1 * c, noise(), 0.1 * r}));
      b.set(r, c, vec_cast<float>(Vec3d{0.1 * c + 0.03, 0.1 * r - 1 + noise(), 1.01 + noise()}));
      if (r == 0 || c == 0) continue;
      const int s = r * n + c;
      triangles.push_back({s - n - 1, s - n, s});
      triangles.push_back({s - n - 1, s, s - 1});
    }
  const auto corners = [&](const Planes3& p, const Triangle& t) {
    return Corners{vec_cast<double>(p.at(t[0])), vec_cast<double>(p.at(t[1])),
                   vec_cast<double>(p.at(t[2]))};
  };
  int brute = 0;
  for (const Triangle& s : triangles)
    for (const Triangle& t : triangles)
      brute += triangles_cross(corners(a, s), corners(b, t)) ? 1 : 0;
  EXPECT_GT(brute, 20);
  EXPECT_EQ(count_intersections({&a, &triangles}, {&b, &triangles}), brute);
}

}  // namespace
}  // namespace weft
