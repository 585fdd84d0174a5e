#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/collide/filter/safe_positions.h"

namespace weft {
namespace {

Vec3d turned(Vec3d p, double angle) {
  const double c = cosine(angle), s = sine(angle);
  return {c * p.x - s * p.y + 0.3, s * p.x + c * p.y - 2, p.z + 0.01};
}

Planes3 moved(const Planes3& start, double angle) {
  Planes3 end(start.size());
  for (int s = 0; s < start.size() * start.size(); ++s)
    end.set(s, vec_cast<float>(turned(vec_cast<double>(start.at(s)), angle)));
  return end;
}

TEST(RigidMotion, IsFoundFromSamplesAlone) {
  const Body body = test::torus(17, 0.5, 0.2);
  const auto motion = rigid_motion(body.positions, moved(body.positions, 0.7));
  ASSERT_TRUE(motion);
  for (const Vec3d p : {Vec3d{1, 2, 3}, Vec3d{}, Vec3d{-0.4, 0.1, 0}})
    EXPECT_LT(length((*motion)(p)-turned(p, 0.7)), 5e-6);
}

TEST(RigidMotion, IsNoneWhereTheSurfaceChanges) {
  const Body body = test::torus(17, 0.5, 0.2);
  Planes3 end = moved(body.positions, 0.7);
  end.set(40, end.at(40) + Vec3f{0, 1e-3F, 0});
  EXPECT_FALSE(rigid_motion(body.positions, end));
}

}  // namespace
}  // namespace weft
