#include "weft/mesh/shapes.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "weft/collide/intersections.h"
#include "weft/mesh/distance.h"
#include "weft/mesh/shapes/mannequin.h"

namespace weft {
namespace {

struct Placed {
  Triangle vertices;
  std::array<Vec3d, 3> corners;
  Box3d box;
};

/// The triangles in order of where their boxes begin along x.
std::vector<Placed> swept(const TriangleMesh& mesh) {
  std::vector<Placed> all;
  for (const Triangle& t : mesh.triangles) {
    Placed placed{t, {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}, {}};
    for (const Vec3d p : placed.corners) placed.box.add(p);
    all.push_back(placed);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Placed& a, const Placed& b) { return a.box.lower.x < b.box.lower.x; });
  return all;
}

bool share_a_vertex(const Triangle& a, const Triangle& b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

bool cross(const Placed& a, const Placed& b) {
  return a.box.lower.y <= b.box.upper.y && b.box.lower.y <= a.box.upper.y &&
         a.box.lower.z <= b.box.upper.z && b.box.lower.z <= a.box.upper.z &&
         triangles_cross(a.corners, b.corners);
}

int self_crossings(const TriangleMesh& mesh) {
  const std::vector<Placed> all = swept(mesh);
  int count = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size() && all[j].box.lower.x <= all[i].box.upper.x; ++j)
      if (!share_a_vertex(all[i].vertices, all[j].vertices) && cross(all[i], all[j])) ++count;
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
    EXPECT_EQ(self_crossings(make_shape(shape.name)), 0) << shape.name;
  // The count does find what crosses.
  TriangleMesh moved = make_shape("sphere");
  for (Vec3d& p : moved.positions) p.x += 0.3;
  EXPECT_GT(self_crossings(joined(make_shape("sphere"), moved)), 100);
}

TEST(ShapeSurfaces, GarmentsDoNotTouchTheMannequin) {
  for (const char* garment : {"tshirt", "skirt"})
    EXPECT_EQ(self_crossings(joined(make_shape("mannequin"), make_shape(garment))), 0) << garment;
}

TEST(Skirt, FitsWaistAndHipsWithAFewCentimetresOfEase) {
  const TriangleMesh skirt = make_shape("skirt"), body = make_shape("mannequin");
  const ClosestPointQuery query(body);
  double least = 1, widest_at_hips = 0;
  for (const Vec3d p : sample_surface(skirt, 20000, 1)) {
    EXPECT_GT(mannequin_field(p), 0);
    const double gap = std::sqrt(query.closest(p).squared_distance);
    least = std::min(least, gap);
    if (p.y > 0.9) widest_at_hips = std::max(widest_at_hips, gap);
  }
  EXPECT_GT(least, 0.01);
  EXPECT_LT(least, 0.03);
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
    const Vec3d normal = normalized(weft::cross(skirt.positions[b] - pa, skirt.positions[c] - pa));
    EXPECT_GT(dot(normal, normalized(Vec3d{pa.x, 0, pa.z})), 0) << pa.x << ' ' << pa.y;
  }
}

}  // namespace
}  // namespace weft
