#include <utility>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/integrate/integrator.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/cloth/measure.h"
#include "weft/cloth/neighbours.h"
#include "weft/cloth/strain_limit.h"

namespace weft {
namespace {

using namespace testing;

/// The widths of vectors do not divide these: rows have remainders of every kind.
constexpr int sizes[] = {9, 17, 30, 33, 71};

std::string hash_after_steps(const Cloth& cloth, ThreadTeam& team) {
  const StepInput input;
  const auto integrator = make_integrator(MultigridOptions{.tolerance = 0}, cloth, input, team);
  ClothState state = rest_state(cloth, {0.5F, -1, 0.2F});
  shake(cloth, 0.3 * cloth.rest_spacing, state.position);
  for (int i = 0; i < 4; ++i) {
    integrator->begin(input, state);
    limit_strain(cloth, {}, input.time_step, integrator->iterate({}), team);
    integrator->end(state);
  }
  EXPECT_FALSE(find_not_finite(state));
  return hash_of(state);
}

TEST(Kernels, EveryInstructionSetAndTeamGivesTheSameBits) {
  int sets = 0;
  for (const InstructionSet set : instruction_sets()) sets += has_instruction_set(set) ? 1 : 0;
  for (const int n : sizes)
    for (const bool bends : {false, true})
      for (Cloth cloth : {sheet_cloth(n, {.bend_springs = bends ? 3.0 : 0}), torus_cloth(n)}) {
        pin(cloth, n + 1, vec_cast<double>(cloth.rest.at(n + 1)));
        std::string first;
        for (const InstructionSet set : instruction_sets())
          for (const int threads : {1, 2, 3, 7}) {
            if (!has_instruction_set(set)) continue;
            ThreadTeam team({threads, set});
            const std::string hash = hash_after_steps(cloth, team);
            if (first.empty()) first = hash;
            ASSERT_EQ(hash, first) << name_of(set) << ", " << threads << " threads, " << n;
          }
      }
  RecordProperty("instruction_sets", sets);
}

TEST(Kernels, NamesOfInstructionSetsAreFoundAgain) {
  for (const InstructionSet set : instruction_sets())
    EXPECT_EQ(find_instruction_set(name_of(set)), set);
  EXPECT_EQ(find_instruction_set("avx1024"), std::nullopt);
  EXPECT_TRUE(has_instruction_set(InstructionSet::baseline));
}

/// Sum over columns of the force that a row of springs puts on x, both ends.
TEST(Kernels, SpringsOfARowActOnBothEndsAlike) {
  const int n = 21;
  const Cloth cloth = sheet_cloth(n);
  Planes3 x = cloth.rest;
  shake(cloth, 0.01, x);
  const SpringPlane& plane = cloth.springs[shear_1];
  for (const InstructionSet set : instruction_sets()) {
    if (!has_instruction_set(set)) continue;
    Planes3 out(n), lines(n);
    kernels_for(set).springs(
        {0,
         n - 1,
         1,
         240,
         {plane.rest_length.row(3), plane.stiffness.row(3), plane.damping.row(3)},
         {row_of(std::as_const(x), 3), row_of(cloth.rest, 3)},
         {row_of(std::as_const(x), 4), row_of(cloth.rest, 4)}},
        row_of(lines, 0), row_of(out, 0), row_of(out, 1));
    Vec3d sum;
    double size = 0;
    for (int c = 0; c < n; ++c) {
      sum += vec_cast<double>(out.at(0, c)) + vec_cast<double>(out.at(1, c));
      size += length(vec_cast<double>(out.at(0, c)));
    }
    EXPECT_GT(size, 1);
    EXPECT_LT(length(sum), 1e-6 * size) << name_of(set);
    EXPECT_EQ(out.at(0, n - 1), Vec3f{});
    EXPECT_EQ(out.at(1, 0), Vec3f{});
  }
}

}  // namespace
}  // namespace weft
