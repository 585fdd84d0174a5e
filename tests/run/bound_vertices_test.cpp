#include <limits>

#include <gtest/gtest.h>

#include "weft/convert.h"
#include "weft/run/export/exported_surface.h"
#include "weft/shapes.h"
#include "weft/sim/placement.h"

namespace weft {
namespace {

/// A shape whose image is coarser than its mesh.
struct Bound {
  explicit Bound(const std::string& shape, const Placement& placement = {}) {
    ConvertOptions options;
    options.size = 33;
    options.keep_source = true;
    surface = load_surface("builtin:" + shape, options);
    grid = surface_points(surface.image, false);
    const PlacementMap map = placement_map(placement);
    rest = placed_positions(surface.image, map);
    for (const Vec3d p : surface.source->positions) vertices.push_back(map.point(p));
    bound.emplace(surface.image, grid,
                  BoundVertices::Rest{&rest, surface.source->places, vertices});
  }
  LoadedSurface surface;
  SurfacePoints grid;
  Planes3 rest;
  std::vector<Vec3d> vertices;
  std::optional<BoundVertices> bound;
};

/// Every sample taken elsewhere.
template <class Move>
Planes3 moved(const Planes3& samples, const Move& move) {
  Planes3 there(samples.size());
  for (int s = 0; s < samples.size() * samples.size(); ++s)
    there.set(s, vec_cast<float>(move(vec_cast<double>(samples.at(s)))));
  return there;
}

TEST(BoundVertices, EveryVertexOfAMeshHasAPlaceNearItself) {
  const Bound shirt("tshirt");
  ASSERT_EQ(shirt.surface.source->places.size(), make_shape("tshirt").positions.size());
  double farthest = 0;
  for (std::size_t v = 0; v < shirt.vertices.size(); ++v) {
    const Vec2d place = shirt.surface.source->places[v];
    ASSERT_TRUE(place.x >= 0 && place.x <= 32 && place.y >= 0 && place.y <= 32);
    const int row = static_cast<int>(place.y + 0.5), col = static_cast<int>(place.x + 0.5);
    farthest =
        std::max(farthest, length(vec_cast<double>(shirt.rest.at(row, col)) - shirt.vertices[v]));
  }
  EXPECT_LT(farthest, 0.08);  // a shirt of a metre in 33 samples, and shapes stretch
}

TEST(BoundVertices, RestComesBackBitForBit) {
  for (const char* shape : {"tshirt", "box", "double_torus"}) {
    const Bound bound(shape, {{1.3, 0.7, 1.1}, {20, 130, -70}, {0.3, 1.7, -2}});
    EXPECT_EQ(bound.bound->follow(bound.rest), bound.vertices) << shape;
  }
}

TEST(BoundVertices, WhatIsFinerThanTheImageTurnsAlong) {
  // The box's edges lie beside the samples of its image.
  const Bound box("box");
  const PlacementMap turn = placement_map({{1, 1, 1}, {40, -70, 100}, {0.2, 3, -1}});
  const Planes3 there = moved(box.rest, [&](Vec3d p) { return turn.point(p); });
  const std::vector<Vec3d> found = box.bound->follow(there);
  for (std::size_t v = 0; v < found.size(); ++v)
    EXPECT_LT(length(found[v] - turn.point(box.vertices[v])), 2e-6) << v;
}

TEST(BoundVertices, StretchedSurfacesCarryTheirVerticesAlong) {
  // What lies beside the samples' triangles turns and does not shear: an approximation.
  const Bound shirt("tshirt");
  const auto bend = [](Vec3d p) { return Vec3d{p.x + 0.1 * p.y * p.y, p.y, p.z + 0.2 * p.x}; };
  const std::vector<Vec3d> found = shirt.bound->follow(moved(shirt.rest, bend));
  double farthest = 0;
  for (std::size_t v = 0; v < found.size(); ++v)
    farthest = std::max(farthest, length(found[v] - bend(shirt.vertices[v])));
  EXPECT_LT(farthest, 0.006);
}

TEST(BoundVertices, VerticesOnNoSurfaceStay) {
  Bound box("box");
  std::vector<Vec2d> places = box.surface.source->places;
  places[3] = {std::numeric_limits<double>::quiet_NaN(), 0};
  const BoundVertices bound(box.surface.image, box.grid, {&box.rest, places, box.vertices});
  const Planes3 there = moved(box.rest, [](Vec3d p) { return p + Vec3d{0, 1, 0}; });
  const std::vector<Vec3d> found = bound.follow(there);
  EXPECT_EQ(found[3], box.vertices[3]);
  EXPECT_NEAR(found[4].y, box.vertices[4].y + 1, 1e-6);
}

}  // namespace
}  // namespace weft
