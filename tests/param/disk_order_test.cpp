#include <algorithm>

#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "weft/param/coarse_to_fine.h"

namespace weft {
namespace {

DiskMesh shuffled_sheet(int cells) { return test::shuffled(test::flat_sheet(cells)); }

double mean_gap(const DiskMesh& disk) {
  double sum = 0;
  for (const auto& [a, b, c] : disk.triangles) sum += std::abs(a - b) + std::abs(b - c);
  return sum / static_cast<double>(disk.triangles.size());
}

TEST(DiskOrder, HoldsTheSameDisk) {
  const DiskMesh disk = shuffled_sheet(12);
  const OrderedDisk ordered = breadth_first(disk);
  ASSERT_EQ(ordered.vertex.size(), disk.positions.size());
  std::vector<Triangle> back = ordered.disk.triangles;
  for (Triangle& t : back)
    for (int& v : t) v = ordered.vertex[v];
  std::vector<Triangle> whole = disk.triangles;
  std::sort(back.begin(), back.end());
  std::sort(whole.begin(), whole.end());
  EXPECT_EQ(back, whole);
  for (std::size_t v = 0; v < ordered.vertex.size(); ++v) {
    EXPECT_EQ(ordered.disk.positions[v], disk.positions[ordered.vertex[v]]);
    EXPECT_EQ(ordered.disk.surface_vertex[v], disk.surface_vertex[ordered.vertex[v]]);
  }
  ASSERT_EQ(ordered.disk.border.size(), disk.border.size());
  for (std::size_t b = 0; b < disk.border.size(); ++b)
    EXPECT_EQ(ordered.vertex[ordered.disk.border[b]], disk.border[b]);
}

TEST(DiskOrder, BringsNeighboursTogether) {
  const DiskMesh disk = shuffled_sheet(40);
  EXPECT_LT(mean_gap(breadth_first(disk).disk), 0.2 * mean_gap(disk));
}

TEST(DiskOrder, KeepsVerticesWithoutTrianglesLast) {
  DiskMesh disk = shuffled_sheet(4);
  disk.positions.insert(disk.positions.begin(), {9, 9, 9});
  disk.surface_vertex.insert(disk.surface_vertex.begin(), 25);
  for (Triangle& t : disk.triangles)
    for (int& v : t) ++v;
  for (int& v : disk.border) ++v;
  EXPECT_EQ(breadth_first(disk).vertex.back(), 0);
}

}  // namespace
}  // namespace weft
