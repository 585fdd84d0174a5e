#include <gtest/gtest.h>

#include "tests/cloth/validation.h"
#include "weft/cloth/baselines/spring_matrix.h"
#include "weft/cloth/bending.h"
#include "weft/cloth/mates.h"

namespace weft {
namespace {

using namespace testing;

/// Springs and bending, whole.
Planes3 forces(const Cloth& cloth, const Planes3& position) {
  Planes3 force(cloth.size);
  const SpringForces springs(cloth);
  BendingPass bending(cloth);
  ThreadTeam alone(1);
  alone.run([&](Worker& worker) {
    bending.curve(position, worker);
    for (int r = 0; r < cloth.size; ++r) {
      springs.gather_elastic(r, position, force);
      bending.add_row(1, r, force);
    }
    sum_over_mates(cloth.mates, worker, {&force.x, &force.y, &force.z});
  });
  return force;
}

double largest(const Planes3& planes) {
  double max = 0;
  for (int s = 0; s < planes.size() * planes.size(); ++s)
    max = std::max(max, length(vec_cast<double>(planes.at(s))));
  return max;
}

TEST(ValidationSolver, ForcesAreMinusTheGradientOfTheEnergy) {
  const Cloth cloth = sheet_cloth(9, {.stretch = 20, .shear = 5, .bending = 1e-2});
  ClothState state = rest_state(cloth);
  shake(cloth, 0.02, state.position);
  const Planes3 force = forces(cloth, state.position);
  const float step = 0x1p-9F;
  double worst = 0;
  for (int sample = 0; sample < 81; ++sample)
    for (const Vec3f displacement : {Vec3f{step, 0, 0}, Vec3f{0, step, 0}, Vec3f{0, 0, step}}) {
      ClothState ahead = state, behind = state;
      ahead.position.set(sample, state.position.at(sample) + displacement);
      behind.position.set(sample, state.position.at(sample) - displacement);
      const double rise = potential_energy(cloth, ahead, {}) - potential_energy(cloth, behind, {});
      const double along =
          dot(vec_cast<double>(force.at(sample)), vec_cast<double>(displacement)) / step;
      worst = std::max(worst, std::abs(along + rise / (2.0 * step)));
    }
  check("springs and bending against finite differences: largest error over the largest force", 0,
        worst / largest(force), 1e-3);
}

struct Stepped {
  Planes3 position;
  double residual = 0;
};

/// One long step of a sheet that hangs by two corners.
template <class Options>
Stepped step_once(const Options& options) {
  Cloth cloth = sheet_cloth(33);
  pin_at(cloth, 0, 0, cloth.rest);
  pin_at(cloth, 0, 32, cloth.rest);
  ClothState state = rest_state(cloth);
  shake(cloth, 1e-3, state.position);
  ThreadTeam team(1);
  const StepInput input{1.0 / 240, {0, -9.81F, 0}};
  const auto integrator = make_integrator(options, cloth, input, team);
  const StepReport report = run(*integrator, input, 1, state);
  return {state.position, report.residual * cloth.rest_spacing};
}

/// How far further iterations than the default's move a particle at most, over the residual that
/// the last reported.
template <class Options>
double further_over_residual(Options options = {}) {
  const Stepped stopped = step_once(options);
  options.max_iterations = 1000;
  options.tolerance = 1e-6;
  const Stepped converged = step_once(options);
  double max = 0;
  for (int s = 0; s < 33 * 33; ++s)
    max =
        std::max(max, length(vec_cast<double>(stopped.position.at(s) - converged.position.at(s))));
  return max / stopped.residual;
}

TEST(ValidationSolver, MoreIterationsChangeNoMoreThanTheResidualTells) {
  check("change by further iterations over the residual, newton", 0,
        further_over_residual<NewtonOptions>(), 2);
  check("change by further iterations over the residual, implicit", 0,
        further_over_residual<ImplicitOptions>(), 2);
  check("change by further iterations over the residual, multigrid", 0,
        further_over_residual<MultigridOptions>(), 2);
}

}  // namespace
}  // namespace weft
