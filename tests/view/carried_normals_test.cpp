#include <gtest/gtest.h>

#include "tests/convert/maps.h"
#include "tests/view/shapes.h"
#include "weft/convert/sample.h"
#include "weft/core/math.h"
#include "weft/drawing.h"
#include "weft/error.h"
#include "weft/view/normals.h"

namespace weft {
namespace {

Planes3 each(const Planes3& grid, Vec3f (*map)(Vec3f)) {
  Planes3 mapped(grid.size());
  for (int s = 0; s < grid.size() * grid.size(); ++s) mapped.set(s, map(grid.at(s)));
  return mapped;
}

/// Normals finer than a grid: tilted from texel to texel.
NormalMap rippled(int size) {
  NormalMap normals{Planes3(size)};
  for (int r = 0; r < size; ++r)
    for (int c = 0; c < size; ++c) {
      const Vec3d n{0.3 * sine(1.7 * c), 1, 0.3 * sine(2.3 * r)};
      normals.normal.set(r, c, vec_cast<float>(normalized(n)));
    }
  return normals;
}

TEST(CarriedNormals, TurnWithTheSurface) {
  const Planes3 rest = wavy_sheet(17, 0);
  const auto turn = [](Vec3f p) { return Vec3f{-p.y, p.x, p.z} + Vec3f{1, 2, 3}; };
  const NormalMap normals = rippled(40);
  const NormalMap carried = carried_normals(rest, normals, each(rest, turn), nullptr);
  for (int s = 0; s < 40 * 40; ++s) {
    const Vec3f n = normals.normal.at(s);
    ASSERT_NEAR(length(carried.normal.at(s) - Vec3f{-n.y, n.x, n.z}), 0, 1e-5);
  }
}

TEST(CarriedNormals, StayAcrossASurfaceThatIsStretched) {
  const Planes3 rest = wavy_sheet(65, 0);
  const auto stretch = [](Vec3f p) { return Vec3f{3 * p.x, p.y, 0.5F * p.z}; };
  const Planes3 moved = each(rest, stretch);
  const NormalMap carried = carried_normals(rest, {grid_normals(rest, nullptr)}, moved, nullptr);
  const Planes3 wanted = grid_normals(moved, nullptr);
  for (int r = 1; r < 64; ++r)
    for (int c = 1; c < 64; ++c)
      ASSERT_NEAR(length(carried.normal.at(r, c) - wanted.at(r, c)), 0, 0.01);
}

TEST(CarriedNormals, AreTheGridsOwnWhereItHadNoArea) {
  const auto flatten = [](Vec3f p) { return Vec3f{p.x, 0, 0}; };
  const Planes3 moved = wavy_sheet(9, 0);
  const NormalMap carried = carried_normals(each(moved, flatten), rippled(9), moved, nullptr);
  for (int s = 0; s < 81; ++s) {
    ASSERT_NEAR(length(carried.normal.at(s)), 1, 1e-5);
    ASSERT_LT(carried.normal.at(s).y, 0);  // v runs towards +z: du x dv points down
  }
}

/// Two charts side by side, of which one turns and the other stays.
TEST(CarriedNormals, GoFromNoChartToAnother) {
  const Planes3 rest = wavy_sheet(17, 0);
  Planes3 moved = rest;
  for (int r = 0; r < 17; ++r)
    for (int c = 9; c < 17; ++c) {
      const Vec3f p = rest.at(r, c);
      moved.set(r, c, {-p.y, p.x, p.z});
    }
  const BorderMates mates(17, {{"", 0, 0, 17, 9}, {"", 0, 9, 17, 8}}, {});
  const NormalMap normals = rippled(33);
  const NormalMap carried = carried_normals(rest, normals, moved, &mates);
  for (int r = 0; r < 33; ++r)
    for (int c = 0; c < 33; ++c) {
      const Vec3f n = normals.normal.at(r, c);
      if (c != 17) {  // between the charts
        ASSERT_NEAR(length(carried.normal.at(r, c) - (c > 17 ? Vec3f{-n.y, n.x, n.z} : n)), 0,
                    1e-5);
      }
    }
}

/// Each row moves on its own, so that the two sides of the seam stretch differently.
TEST(CarriedNormals, OfMatesAreTheSame) {
  const int n = 9;
  const MappedDisk torus = maps::torus(n, 65);
  const GeometryImage image = sample_image(torus);
  const Planes3 rest = world_positions(image);
  Planes3 moved = rest;
  for (int s = 0; s < n * n; ++s) {
    const Vec3f p = rest.at(s);
    moved.set(s, {p.x + 0.3F * p.z * p.z, p.y * p.x, p.z});
  }
  const NormalMap carried = carried_normals(rest, sample_normals(torus, n), moved, &image.mates);
  for (int k = 0; k < image.mates.class_count(); ++k)
    for (const int s : image.mates.mates(k))
      EXPECT_LT(length(carried.normal.at(s) - carried.normal.at(image.mates.mates(k)[0])), 1e-6);
}

TEST(CarriedNormals, OfGridsThatDifferInSizeAreRefused) {
  EXPECT_THROW(carried_normals(wavy_sheet(9, 0), rippled(9), wavy_sheet(17, 0), nullptr),
               UsageError);
}

}  // namespace
}  // namespace weft
