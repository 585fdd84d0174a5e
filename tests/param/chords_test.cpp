#include "weft/param/chords.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "weft/mesh/topology.h"

namespace weft {
namespace {

int count_chords(const DiskMesh& disk) {
  const HalfEdges edges = half_edges(static_cast<int>(disk.positions.size()), disk.triangles);
  const std::set<int> border(disk.border.begin(), disk.border.end());
  int chords = 0;
  for (int h = 0; h < static_cast<int>(edges.twin.size()); ++h)
    if (edges.twin[h] > h && border.count(from_vertex(disk.triangles, h)) > 0 &&
        border.count(to_vertex(disk.triangles, h)) > 0)
      ++chords;
  return chords;
}

/// A hexagon of four triangles, the middle one bounded by chords alone.
DiskMesh hexagon() {
  DiskMesh disk;
  disk.positions = {{2, 0, 0}, {1, 2, 0}, {-1, 2, 0}, {-2, 0, 0}, {-1, -2, 0}, {1, -2, 0}};
  disk.triangles = {{0, 1, 2}, {2, 3, 4}, {4, 5, 0}, {0, 2, 4}};
  disk.border = {0, 1, 2, 3, 4, 5};
  disk.surface_vertex = {0, 1, 2, 3, 4, 9};
  return disk;
}

double area(const DiskMesh& disk) {
  double sum = 0;
  for (const auto& [a, b, c] : disk.triangles)
    sum +=
        0.5 * cross(disk.positions[b] - disk.positions[a], disk.positions[c] - disk.positions[a]).z;
  return sum;
}

TEST(Chords, TriangleOfThreeChordsIsSplitAtAllOfThem) {
  DiskMesh disk = hexagon();
  const double before = area(disk);
  EXPECT_EQ(split_chords(disk), 3);
  EXPECT_EQ(count_chords(disk), 0);
  EXPECT_EQ(disk.triangles.size(), 4U + 3U * 2U);
  EXPECT_NEAR(area(disk), before, 1e-12);
}

TEST(Chords, BorderStaysAndNewVerticesGetNewSurfaceIds) {
  DiskMesh disk = hexagon();
  const DiskMesh before = disk;
  split_chords(disk);
  EXPECT_EQ(disk.border, before.border);
  EXPECT_EQ(std::vector<int>(disk.surface_vertex.begin() + 6, disk.surface_vertex.end()),
            (std::vector<int>{10, 11, 12}));
}

TEST(Chords, TriangleWithTwoChordsIsSplitAtBoth) {
  DiskMesh disk = hexagon();
  disk.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  EXPECT_EQ(count_chords(disk), 3);
  EXPECT_EQ(split_chords(disk), 3);
  EXPECT_EQ(count_chords(disk), 0);
  EXPECT_NEAR(area(disk), area(hexagon()), 1e-12);
}

TEST(Chords, SheetHasThemOnlyAcrossItsCorners) {
  DiskMesh disk = test::flat_sheet(6);
  EXPECT_EQ(split_chords(disk), count_chords(test::flat_sheet(6)));
  EXPECT_EQ(count_chords(disk), 0);
}

}  // namespace
}  // namespace weft
