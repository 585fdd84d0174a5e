#include "weft/cloth/kernels/filtering_kernels.h"

#include <utility>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/baselines/filter_matrix.h"
#include "weft/cloth/measure.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

using namespace testing;

std::string hash_after_steps(const IntegratorOptions& options, const Cloth& cloth,
                             ThreadTeam& team) {
  const StepInput input;
  const auto integrator = make_integrator(options, cloth, input, team);
  ClothState state = rest_state(cloth, {0.5F, -1, 0.2F});
  shake(cloth, 0.1 * cloth.rest_spacing, state.position);
  run(*integrator, input, 3, state);
  EXPECT_FALSE(find_not_finite(state));
  return hash_of(state);
}

TEST(FilteringKernels, EveryInstructionSetAndTeamGivesTheSameBits) {
  // The widths of vectors do not divide these, nor the halves of the patches.
  for (const int n : {9, 17, 30})
    for (const int patch : {5, 7, 9})
      for (const IntegratorOptions& options :
           {IntegratorOptions(TwoLevelOptions{.local_size = patch}),
            IntegratorOptions(DesbrunOptions{})})
        for (const Cloth& cloth : {sheet_cloth(n), torus_cloth(n)}) {
          std::string first;
          for (const InstructionSet set : instruction_sets())
            for (const int threads : {1, 3}) {
              if (!has_instruction_set(set)) continue;
              ThreadTeam team({threads, set});
              const std::string hash = hash_after_steps(options, cloth, team);
              if (first.empty()) first = hash;
              ASSERT_EQ(hash, first) << name_of(options) << ", " << name_of(set) << ", " << threads
                                     << " threads, " << n;
            }
        }
}

TEST(FilteringKernels, DenseRowsEqualTheSumsInDouble) {
  const int count = 37;
  Random random(1);
  Grid<float> matrix(count, count);
  Vectors3 in(count), out(count);
  for (int i = 0; i < count; ++i) {
    in.set(i, vec_cast<float>(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), 1}));
    for (int j = 0; j < count; ++j) matrix(i, j) = static_cast<float>(random.uniform(-1, 1));
  }
  for (const InstructionSet set : instruction_sets()) {
    if (!has_instruction_set(set)) continue;
    // From an odd row on, so that pairs of rows and a single one occur.
    filtering_kernels_for(set).dense_rows(4, count, {matrix.row(0), matrix.stride()},
                                          std::as_const(in).rows(), out.rows());
    for (int i = 4; i < count; ++i) {
      Vec3d sum;
      for (int j = 0; j < count; ++j) sum += double{matrix(i, j)} * vec_cast<double>(in.at(j));
      EXPECT_LT(length(vec_cast<double>(out.at(i)) - sum), 1e-5) << name_of(set);
    }
    EXPECT_EQ(out.at(3), Vec3f{});
  }
}

TEST(FilteringKernels, SpringsPullAndResist) {
  // Two particles 2 apart on a spring of rest length 1, the other moving away: by hand.
  const float rest = 1, stiffness = 3, viscosity = 0.5F;
  const Vectors3 zero(1);
  Vectors3 there(1), speed(1), force(1);
  there.set(0, {0, 2, 0});
  speed.set(0, {1, 4, 0});
  for (const InstructionSet set : instruction_sets()) {
    if (!has_instruction_set(set)) continue;
    force.set(0, {0, 1, 0});
    filtering_kernels_for(set).viscous_springs(
        {&rest, &stiffness, &viscosity, zero.rows(), zero.rows(), std::as_const(there).rows(),
         std::as_const(speed).rows(), 0, 1},
        force.rows());
    EXPECT_EQ(force.at(0), (Vec3f{0.5F, 1 + 3 + 2, 0}));
  }
}

}  // namespace
}  // namespace weft
