#include "weft/collide/contacts/surface_motion.h"

#include <gtest/gtest.h>

#include "tests/collide/test_bodies.h"
#include "weft/collide/contacts/block_motion.h"
#include "weft/core/random.h"

namespace weft {
namespace {

/// A ball's image with dents, with both kinds of diagonals, and some cells left out.
struct Dented {
  explicit Dented(int size) : body(test::octahedral_sphere(size, 0.5, {})) {
    Random random(3);
    body.diagonals = Grid<Diagonal>(size - 1, size - 1);
    for (int r = 0; r + 1 < size; ++r)
      for (int c = 0; c + 1 < size; ++c) {
        const int kind = random.index(12);
        body.diagonals(r, c) = kind == 0  ? Diagonal::none
                               : kind < 6 ? Diagonal::rising
                                          : Diagonal::falling;
      }
    grid = SurfaceGrid(size, body.mates, body.diagonals);
    for (int time = 0; time < 3; ++time) places.push_back(dented(random));
  }
  [[nodiscard]] Planes3 dented(Random& random) const {
    Planes3 at = body.positions;
    for (int s = 0; s < at.size() * at.size(); ++s)
      at.set(s,
             at.at(s) + 0.01F * vec_cast<float>(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1),
                                                      random.uniform(-1, 1)}));
    for (int k = 0; k < body.mates.class_count(); ++k)
      for (const int sample : body.mates.mates(k)) at.set(sample, at.at(body.mates.mates(k)[0]));
    return at;
  }
  Body body;
  SurfaceGrid grid;
  std::vector<Planes3> places;
};

/// Areas of the triangles around all points, summed one by one.
struct Areas {
  std::vector<Vec3d> sum;
  std::vector<double> size;
  Areas(const SurfaceGrid& grid, const Planes3& at)
      : sum(static_cast<std::size_t>(grid.size()) * grid.size()), size(sum.size()) {
    for (int t = 0; t < 2 * grid.cells() * grid.cells(); ++t) {
      const std::array<int, 3> s = grid.triangle(t / 2, t % 2);
      const auto corner = [&](int k) { return vec_cast<double>(at.at(s[k])); };
      if (grid.folded(s)) continue;
      const Vec3d area = cross(corner(1) - corner(0), corner(2) - corner(0));
      for (const int sample : s) {
        sum[grid.point(sample)] += area;
        size[grid.point(sample)] += length(area);
      }
    }
  }
};

TEST(SurfaceMotion, NormalsAreMeansOfTheTrianglesAroundPoints) {
  const Dented dented(18);
  SurfaceMotion motion(dented.grid);
  ThreadTeam team(3);
  motion.measure(dented.places[0], dented.places[1], team);
  int bare = 0;
  for (const bool end : {false, true}) {
    const Areas areas(dented.grid, dented.places[end ? 1 : 0]);
    const SurfaceMotion::Normals& found = end ? motion.at_end() : motion.at_start();
    for (int s = 0; s < 18 * 18; ++s) {
      const auto point = static_cast<std::size_t>(dented.grid.point(s));
      const int row = s / 18, col = s % 18;
      if (areas.size[point] == 0) {
        ++bare;
        EXPECT_EQ(found.unit.at(row, col), Vec3f{});
        continue;
      }
      EXPECT_LT(length(vec_cast<double>(found.unit.at(row, col)) - normalized(areas.sum[point])),
                1e-5);
      const double lost = 1 - length(areas.sum[point]) / areas.size[point];
      EXPECT_NEAR(found.slant(row, col), 2 * std::sqrt(2 * lost), 2e-3);
    }
  }
  EXPECT_LT(bare, 18);
}

TEST(SurfaceMotion, WhereAStepStartsIsWhereTheLastOneEnded) {
  const Dented dented(17);
  SurfaceMotion goes_on(dented.grid), fresh(dented.grid);
  ThreadTeam team(2);
  goes_on.measure(dented.places[0], dented.places[2], team);
  goes_on.measure(dented.places[0], dented.places[1], team);
  goes_on.arrive();
  goes_on.measure(dented.places[1], dented.places[2], team);
  fresh.measure(dented.places[1], dented.places[2], team);
  for (int s = 0; s < 17 * 17; ++s) {
    EXPECT_EQ(goes_on.at_start().unit.at(s), fresh.at_start().unit.at(s));
    EXPECT_EQ(goes_on.at_end().unit.at(s), fresh.at_end().unit.at(s));
    EXPECT_EQ(goes_on.approach(s / 17, s % 17), fresh.approach(s / 17, s % 17));
    EXPECT_EQ(goes_on.turn(s / 17, s % 17), fresh.turn(s / 17, s % 17));
  }
}

/// Everything that two measures of one motion tell, compared bit by bit.
void expect_same(const BlockMotion& a, const BlockMotion& b) {
  ASSERT_EQ(a.blocks().size(), b.blocks().size());
  EXPECT_EQ(a.max_moved(), b.max_moved());
  EXPECT_EQ(a.max_approach(), b.max_approach());
  for (std::size_t i = 0; i < a.blocks().size(); ++i) {
    const BlockMotion::Block &one = a.blocks()[i], &other = b.blocks()[i];
    EXPECT_EQ(one.displacement, other.displacement);
    EXPECT_EQ(one.swept.lower, other.swept.lower);
    EXPECT_EQ(one.apart, other.apart);
    EXPECT_EQ(one.normal_apart, other.normal_apart);
    EXPECT_EQ(one.slant, other.slant);
    EXPECT_EQ(one.turn, other.turn);
  }
}

TEST(SurfaceMotion, TeamsAndInstructionsChangeNoBits) {
  const Dented dented(33);
  SurfaceMotion plain(dented.grid);
  BlockMotion plain_blocks;
  ThreadTeam alone({1, InstructionSet::baseline});
  plain.measure(dented.places[0], dented.places[1], alone);
  plain_blocks.measure(dented.grid, dented.places[0], dented.places[1], &plain, alone);
  for (const InstructionSet set : instruction_sets())
    for (const int threads : {1, 2, 3, 7}) {
      if (!has_instruction_set(set)) continue;
      ThreadTeam team({threads, set});
      SurfaceMotion other(dented.grid);
      BlockMotion other_blocks;
      other.measure(dented.places[0], dented.places[1], team);
      other_blocks.measure(dented.grid, dented.places[0], dented.places[1], &other, team);
      expect_same(plain_blocks, other_blocks);
    }
}

/// How far a sample approaches what goes by `along`, as a contact would see it.
double approach_of(const Dented& dented, const SurfaceMotion* slides, int s, Vec3d along) {
  const Vec3d left =
      vec_cast<double>(dented.places[1].at(s)) - vec_cast<double>(dented.places[0].at(s)) - along;
  if (slides == nullptr) return length(left);
  const Vec3d normal = 0.5 * (vec_cast<double>(slides->at_start().unit.at(s)) +
                              vec_cast<double>(slides->at_end().unit.at(s)));
  const double slant = slides->at_start().slant(s / dented.grid.size(), s % dented.grid.size());
  return std::abs(dot(normal, left)) + slant * length(left);
}

TEST(BlockMotion, BoundsTheApproachOfAllThatIsNear) {
  constexpr int size = 43;  // blocks that are not whole, too
  const Dented dented(size);
  SurfaceMotion surface(dented.grid);
  ThreadTeam team(2);
  surface.measure(dented.places[0], dented.places[1], team);
  std::vector<int> list;
  Random random(9);
  for (const SurfaceMotion* slides :
       {static_cast<const SurfaceMotion*>(nullptr), static_cast<const SurfaceMotion*>(&surface)}) {
    BlockMotion motion;
    motion.measure(dented.grid, dented.places[0], dented.places[1], slides, team);
    int near_any = 0;
    for (int i = 0; i < 40; ++i) {
      const Vec3f at = dented.places[0].at(random.index(size * size));
      const Box3f box{at, at + Vec3f{0.05F, 0.05F, 0.05F}};
      constexpr float reach = 0.03F;
      const BlockMotion::Near exact = motion.near(box, reach, 0, list),
                              quick = motion.near(box, reach, HUGE_VAL, list);
      double most = 0;
      for (int s = 0; s < size * size; ++s) {
        const Vec3f start = dented.places[0].at(s), end = dented.places[1].at(s);
        if (!overlap({min(start, end), max(start, end)}, box, reach)) continue;
        most = std::max(most, approach_of(dented, slides, s, exact.displacement));
        ++near_any;
      }
      EXPECT_GE(exact.approach, most);
      EXPECT_GE(quick.approach, exact.approach * (1 - 1e-6));
      EXPECT_EQ(quick.displacement, exact.displacement);
    }
    EXPECT_GT(near_any, 100);
  }
}

}  // namespace
}  // namespace weft
