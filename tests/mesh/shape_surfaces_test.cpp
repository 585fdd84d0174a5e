#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "weft/mesh/crossings.h"
#include "weft/mesh/distance.h"
#include "weft/mesh/shapes/mannequin.h"
#include "weft/shapes.h"

namespace weft {
namespace {

int crossing_count(const TriangleMesh& mesh) {
  int count = 0;
  for_self_crossings(corners_of(mesh), {}, [&](int, int) { ++count; });
  return count;
}

TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const int first = static_cast<int>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const Triangle& t : b.triangles)
    a.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return a;
}

TEST(ShapeSurfaces, NonePassesThroughItself) {
  for (const ShapeInfo& shape : built_in_shapes())
    EXPECT_EQ(crossing_count(make_shape(shape.name)), 0) << shape.name;
  // The count does find what crosses.
  TriangleMesh moved = make_shape("sphere");
  for (Vec3d& p : moved.positions) p.x += 0.3;
  EXPECT_GT(crossing_count(joined(make_shape("sphere"), moved)), 100);
}

TEST(ShapeSurfaces, GarmentsDoNotTouchTheMannequin) {
  for (const char* garment : {"tshirt", "skirt"})
    EXPECT_EQ(crossing_count(joined(make_shape("mannequin"), make_shape(garment))), 0) << garment;
}

TEST(Skirt, FitsWaistAndHipsWithAFewCentimetresOfEase) {
  const TriangleMesh skirt = make_shape("skirt"), body = make_shape("mannequin");
  const ClosestPointQuery query(body);
  double min = 1, widest_at_hips = 0;
  for (const Vec3d p : sample_surface(skirt, 20000, 1)) {
    EXPECT_GT(mannequin_field(p), 0);
    const double gap = std::sqrt(query.closest(p).squared_distance);
    min = std::min(min, gap);
    if (p.y > 0.9) widest_at_hips = std::max(widest_at_hips, gap);
  }
  EXPECT_GT(min, 0.01);
  EXPECT_LT(min, 0.03);
  EXPECT_LT(widest_at_hips, 0.05);
}

TEST(Skirt, IsHeldByTheHipsAndFacesAwayFromTheBody) {
  const TriangleMesh skirt = make_shape("skirt");
  double waist = 0;
  for (const Vec3d p : skirt.positions)
    if (p.y > 1.055) waist = std::max(waist, p.x);
  EXPECT_LT(mannequin_field({waist, 0.9, 0}), 0);  // the waist's width is within the hips
  for (const auto& [a, b, c] : skirt.triangles) {
    const Vec3d pa = skirt.positions[a];
    const Vec3d normal = normalized(cross(skirt.positions[b] - pa, skirt.positions[c] - pa));
    EXPECT_GT(dot(normal, normalized(Vec3d{pa.x, 0, pa.z})), 0) << pa.x << ' ' << pa.y;
  }
}

}  // namespace
}  // namespace weft
