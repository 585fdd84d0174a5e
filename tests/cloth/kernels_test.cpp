#include <utility>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/baselines/spring_matrix.h"
#include "weft/cloth/baselines/strain_limit.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/cloth/measure.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

using namespace testing;

/// The widths of vectors do not divide these: rows have remainders of every kind.
constexpr int sizes[] = {9, 17, 30, 33, 71};

/// A method and a step that it bears.
struct Method {
  IntegratorOptions options;
  StepInput input{};
};

std::string hash_after_steps(const Method& method, const Cloth& cloth, ThreadTeam& team) {
  const StepInput& input = method.input;
  const auto integrator = make_integrator(method.options, cloth, input, team);
  ClothState state = rest_state(cloth, {0.5F, -1, 0.2F});
  shake(cloth, 0.3 * cloth.rest_spacing, state.position);
  for (int i = 0; i < 4; ++i) {
    integrator->begin(input, state);
    limit_strain(cloth, {.strain = 0.05}, input.time_step, integrator->iterate({}), team);
    integrator->end(state);
  }
  EXPECT_FALSE(find_not_finite(state));
  return hash_of(state);
}

void expect_the_same_bits(const Method& method, const Cloth& cloth) {
  std::string first;
  for (const InstructionSet set : instruction_sets())
    for (const int threads : {1, 2, 3, 7}) {
      if (!has_instruction_set(set)) continue;
      ThreadTeam team({threads, set});
      const std::string hash = hash_after_steps(method, cloth, team);
      if (first.empty()) first = hash;
      ASSERT_EQ(hash, first) << name_of(method.options) << ", " << name_of(set) << ", " << threads
                             << " threads, " << cloth.size;
    }
}

TEST(Kernels, EveryInstructionSetAndTeamGivesTheSameBits) {
  int sets = 0;
  for (const InstructionSet set : instruction_sets()) sets += has_instruction_set(set) ? 1 : 0;
  for (const int n : sizes)
    for (const bool bends : {false, true})
      for (Cloth cloth : {sheet_cloth(n, {.bend_springs = bends ? 3.0 : 0}), torus_cloth(n)}) {
        pin(cloth, n + 1, vec_cast<double>(cloth.rest.at(n + 1)));
        for (const Method& method : {Method{MultigridOptions{.tolerance = 0}},
                                     Method{ImplicitOptions{.max_iterations = 12, .tolerance = 0}},
                                     Method{ExplicitOptions{}, {.time_step = 1e-5}}})
          expect_the_same_bits(method, cloth);
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

TEST(Kernels, BlocksTimesTheirInversesAreTheIdentity) {
  const int n = 21;
  Random random(5);
  Blocks blocks, inverses;
  for (Blocks* planes : {&blocks, &inverses})
    for (Grid<float>& plane : *planes) plane = Grid<float>(1, n);
  Grid<float> moves(1, n);
  // A light particle on stiff springs in two directions: 1e-6 kg, 1e-3 kg beside.
  for (int c = 0; c < n; ++c) {
    moves(0, c) = c == 3 ? 0.0F : 1.0F;
    for (const int i : {0, 3, 5}) blocks[i](0, c) = 1e-6F;
    for (int k = 0; k < 2; ++k) {
      const auto some = [&] { return static_cast<float>(random.uniform(-0.03, 0.03)); };
      const float x = some(), y = some(), z = some();
      const float products[] = {x * x, x * y, x * z, y * y, y * z, z * z};
      for (int i = 0; i < 6; ++i) blocks[i](0, c) += products[i];
    }
  }
  for (const InstructionSet set : instruction_sets()) {
    if (!has_instruction_set(set)) continue;
    const ImplicitKernels& kernels = implicit_kernels_for(set);
    const BlockRow in = row_of(std::as_const(blocks), 0);
    kernels.invert_blocks(n, {in, in, nullptr, moves.row(0), 1, 0, 0}, row_of(inverses, 0));
    Planes3 value(n);
    for (int c = 0; c < n; ++c) value.set(0, c, {1, -2, 0.5F});
    kernels.multiply_blocks(n, row_of(std::as_const(inverses), 0), row_of(value, 0));
    kernels.multiply_blocks(n, in, row_of(value, 0));
    for (int c = 0; c < n; ++c) {
      const Vec3f wanted = c == 3 ? Vec3f{} : Vec3f{1, -2, 0.5F};
      EXPECT_LT(length(value.at(0, c) - wanted), 2e-2F) << name_of(set) << ", column " << c;
    }
  }
}

}  // namespace
}  // namespace weft
