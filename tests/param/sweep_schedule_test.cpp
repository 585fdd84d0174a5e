#include <gtest/gtest.h>

#include "tests/param/disks.h"
#include "weft/param/local_newton.h"

namespace weft {
namespace {

TEST(SweepSchedule, TakesEveryInnerVertexAfterItsLesserNeighbours) {
  const DiskMesh disk = test::shuffled(test::flat_sheet(20));
  const CollapseHierarchy mesh(disk);
  const SweepSchedule schedule = schedule_sweep(mesh);
  ASSERT_EQ(schedule.vertices.size(), 19U * 19U);
  std::vector<int> group(disk.positions.size(), -1);
  for (int g = 0; g < schedule.group_count(); ++g)
    for (int i = schedule.first[g]; i < schedule.first[g + 1]; ++i) {
      EXPECT_EQ(group[schedule.vertices[i]], -1) << "twice";
      group[schedule.vertices[i]] = g;
    }
  for (const int v : schedule.vertices)
    mesh.around(v, [&](int h) {
      const int u = mesh.to(h);
      if (mesh.is_inner(u)) {
        EXPECT_EQ(u < v, group[u] < group[v]);
        EXPECT_NE(group[u], group[v]);
      }
    });
}

TEST(SweepSchedule, HasOneGroupForOneVertex) {
  const SweepSchedule one = schedule_sweep(CollapseHierarchy(test::flat_sheet(2)));
  EXPECT_EQ(one.group_count(), 1);
  EXPECT_EQ(one.vertices, std::vector<int>{4});
}

}  // namespace
}  // namespace weft
