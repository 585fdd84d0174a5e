#include "weft/mesh/partition.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tests/mesh/small_meshes.h"
#include "tests/support/meshes.h"
#include "weft/core/disjoint_sets.h"

namespace weft {
namespace {

EdgeUses edges_of(const TriangleMesh& mesh) {
  return edge_uses(static_cast<int>(mesh.positions.size()), mesh.triangles);
}

/// [F] the region of each triangle, which parted edges bound.
std::vector<int> regions_of(const TriangleMesh& mesh, const EdgeUses& edges,
                            const std::vector<bool>& parted) {
  DisjointSets sets(static_cast<int>(mesh.triangles.size()));
  for (int e = 0; e < edges.edge_count(); ++e)
    if (!parted[e] && edges.of(e).size() == 2) sets.join(edges.of(e)[0] / 3, edges.of(e)[1] / 3);
  std::vector<int> regions;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) regions.push_back(sets.root(t));
  return regions;
}

std::size_t count_of(const std::vector<int>& regions) {
  return std::set<int>(regions.begin(), regions.end()).size();
}

TEST(Partition, RegionsAreConnectedAndAsManyAsAsked) {
  const TriangleMesh mesh = test::torus(20, 30);
  const EdgeUses edges = edges_of(mesh);
  for (const int count : {2, 5, 12}) {
    std::vector<bool> parted(edges.edge_count(), false);
    EXPECT_EQ(part_in_regions(mesh, edges, {.regions = count}, parted), count);
    const std::vector<int> regions = regions_of(mesh, edges, parted);
    EXPECT_EQ(count_of(regions), static_cast<std::size_t>(count));
    std::vector<std::size_t> sizes;
    for (const int region : std::set<int>(regions.begin(), regions.end()))
      sizes.push_back(static_cast<std::size_t>(std::count(regions.begin(), regions.end(), region)));
    const auto [min, max] = std::minmax_element(sizes.begin(), sizes.end());
    EXPECT_LT(*max, 5 * *min) << count << ": no sliver beside a giant";
  }
}

TEST(Partition, PiecesAreRegionsOfTheirOwn) {
  const TriangleMesh mesh =
      test::together(test::together(test::tetrahedron(), test::tetrahedron()), test::torus(5, 7));
  const EdgeUses edges = edges_of(mesh);
  std::vector<bool> parted(edges.edge_count(), false);
  EXPECT_EQ(part_in_regions(mesh, edges, {.regions = 2}, parted), 3);
  EXPECT_EQ(std::count(parted.begin(), parted.end(), true), 0);
}

TEST(Partition, WhatMayNotBeDividedStaysWhole) {
  const TriangleMesh mesh = test::together(test::torus(20, 30), test::torus(5, 7));
  const EdgeUses edges = edges_of(mesh);
  constexpr std::size_t first = 2 * 20 * 30;
  std::vector<bool> divisible(mesh.triangles.size(), true), parted(edges.edge_count(), false);
  std::fill(divisible.begin(), divisible.begin() + first, false);
  EXPECT_EQ(part_in_regions(mesh, edges, {.regions = 4, .divisible = divisible}, parted), 4);
  const std::vector<int> regions = regions_of(mesh, edges, parted);
  EXPECT_EQ(count_of({regions.begin(), regions.begin() + first}), 1u);
  EXPECT_EQ(count_of({regions.begin() + first, regions.end()}), 3u);
}

TEST(Partition, NoMoreRegionsThanTriangles) {
  const TriangleMesh mesh = test::tetrahedron();
  const EdgeUses edges = edges_of(mesh);
  std::vector<bool> parted(edges.edge_count(), false);
  EXPECT_EQ(part_in_regions(mesh, edges, {.regions = 100}, parted), 4);
}

TEST(Partition, TextureSeamsAreWhereCoordinatesDiffer) {
  TriangleMesh mesh = test::torus(6, 8);
  const EdgeUses edges = edges_of(mesh);
  for (const Triangle& t : mesh.triangles)
    mesh.corner_uv.push_back({Vec2f{float(t[0]), 0}, Vec2f{float(t[1]), 0}, Vec2f{float(t[2]), 0}});
  std::vector<bool> parted(edges.edge_count(), false);
  EXPECT_EQ(part_at_texture_seams(mesh, edges, parted), 0);
  // An island of one triangle.
  for (Vec2f& uv : mesh.corner_uv[10]) uv.y = 1;
  EXPECT_EQ(part_at_texture_seams(mesh, edges, parted), 3);
  EXPECT_EQ(count_of(regions_of(mesh, edges, parted)), 2U);
}

}  // namespace
}  // namespace weft
