#include "weft/param/collapse_hierarchy.h"

#include <algorithm>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "tests/param/terrible_disks.h"
#include "weft/param/chords.h"
#include "weft/param/collapse_passes.h"

namespace weft {
namespace {

DiskMesh hilly_sheet() {
  DiskMesh disk = test::sheet(20, [](double x, double y) { return x * x * y; });
  split_chords(disk);
  return disk;
}

int inner_vertices(const CollapseHierarchy& mesh) {
  int count = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) count += mesh.is_inner(v) ? 1 : 0;
  return count;
}

/// That the rest is a disk with the border that it had, has no chord, and that valences are right.
void expect_disk(const CollapseHierarchy& mesh, const DiskMesh& fine) {
  const CoarseDisk coarse = coarse_disk(mesh, fine);
  const int count = static_cast<int>(coarse.disk.positions.size());
  const TopologyCounts counts = count_topology(count, coarse.disk.triangles);
  EXPECT_EQ(counts.euler, 1);
  EXPECT_EQ(counts.boundaries, 1);
  EXPECT_EQ(counts.components, 1);
  EXPECT_EQ(counts.vertices, count);
  EXPECT_EQ(counts.triangles, mesh.triangle_count());
  const HalfEdges edges = half_edges(count, coarse.disk.triangles);
  const std::set<int> border(coarse.disk.border.begin(), coarse.disk.border.end());
  std::vector<int> valence(count, 0);
  for (int h = 0; h < static_cast<int>(edges.twin.size()); ++h) {
    const int a = from_vertex(coarse.disk.triangles, h);
    const int b = to_vertex(coarse.disk.triangles, h);
    ++valence[a];
    if (edges.twin[h] < 0) ++valence[b];
    EXPECT_EQ(edges.twin[h] < 0, border.contains(a) && border.contains(b));
  }
  for (int v = 0; v < count; ++v) EXPECT_EQ(valence[v], mesh.valence(coarse.vertex[v]));
}

TEST(CollapseHierarchy, StaysADiskWithItsBorderDownToAWheel) {
  for (const DiskMesh& disk :
       {hilly_sheet(), test::long_neck(5, 40, 0.1), test::sliver_fan(60, 10)}) {
    CollapseHierarchy mesh(disk);
    const PassOptions down{.triangles = mesh.triangle_count() / 3, .first_cost = 6, .growth = 1.25};
    collapse_in_passes(mesh, min_valence_first(), down);
    expect_disk(mesh, disk);
    collapse_in_passes(mesh, min_valence_first(),
                       {.triangles = 0, .first_cost = 6, .growth = 1.25});
    expect_disk(mesh, disk);
    EXPECT_EQ(inner_vertices(mesh), 1);
    EXPECT_EQ(mesh.triangle_count(), static_cast<int>(disk.border.size()));
  }
}

TEST(CollapseHierarchy, ComesBackTriangleForTriangle) {
  const DiskMesh disk = hilly_sheet();
  CollapseHierarchy mesh(disk);
  collapse_in_passes(mesh, min_valence_first(),
                     {.triangles = 300, .first_cost = 6, .growth = 1.25});
  const CoarseDisk half_way = coarse_disk(mesh, disk);
  const int depth = mesh.depth();
  collapse_in_passes(mesh, min_valence_first(), {.triangles = 0, .first_cost = 6, .growth = 1.25});
  while (mesh.depth() > depth) mesh.undo();
  EXPECT_EQ(coarse_disk(mesh, disk).disk.triangles, half_way.disk.triangles);
  EXPECT_EQ(coarse_disk(mesh, disk).vertex, half_way.vertex);
  while (mesh.depth() > 0) mesh.undo();
  EXPECT_EQ(mesh.triangles(), disk.triangles);
  expect_disk(mesh, disk);
}

TEST(CollapseHierarchy, RefusesToPinchAndToMakeChords) {
  // A tip inside three edges, each of whose ends has a neighbour on the border.
  const DiskMesh disk = test::nested_rings(3, 2, [](int ring, double angle) {
    return Vec3d{(3.0 - ring) * cosine(angle), (3.0 - ring) * sine(angle), 0};
  });
  CollapseHierarchy mesh(disk);
  int to_border = 0;
  int along_ring = 0;
  for (int h = 0; h < 3 * mesh.triangle_count(); ++h) {
    if (!mesh.is_inner(mesh.from(h))) continue;
    const bool from_tip = mesh.from(h) == 6;
    const bool to_tip = mesh.to(h) == 6;
    if (from_tip || to_tip) {
      EXPECT_TRUE(mesh.can_collapse(h));
    } else if (mesh.is_inner(mesh.to(h))) {
      // The tip joins their ring's third vertex to both: the ring would be pinched.
      EXPECT_FALSE(mesh.can_collapse(h));
      ++along_ring;
    } else {
      ++to_border;
    }
  }
  EXPECT_EQ(along_ring, 6);
  EXPECT_GT(to_border, 0);
}

TEST(CollapsePasses, ByLengthThinOutTheDenseParts) {
  DiskMesh disk = test::flat_sheet(40);
  // Half the columns in a tenth of the width.
  for (Vec3d& p : disk.positions) p.x = p.x < 0.5 ? 0.2 * p.x : 0.1 + 1.8 * (p.x - 0.5);
  split_chords(disk);
  CollapseHierarchy mesh(disk);
  collapse_in_passes(mesh, shortest_first(disk),
                     {.triangles = 1200, .first_cost = 1e-5, .growth = 2});
  EXPECT_LE(mesh.triangle_count(), 1200);
  int dense = 0;
  int sparse = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.is_inner(v)) ++(disk.positions[v].x < 0.1 ? dense : sparse);
  EXPECT_LT(2 * dense, sparse);
}

}  // namespace
}  // namespace weft
