#include <gtest/gtest.h>

#include "tests/cloth/baselines/filter_residual.h"
#include "tests/cloth/sheets.h"
#include "weft/cloth/baselines/filter_matrix.h"
#include "weft/cloth/baselines/filtered_integrator.h"
#include "weft/cloth/baselines/multigrid/multigrid_preconditioner.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/measure.h"
#include "weft/error.h"

namespace weft {
namespace {

using namespace testing;

constexpr double frame = 1.0 / 60;

/// Own part of the forces of the cloth's springs with implicit Euler's viscous term, summed over
/// mates.
Planes3 forces_of(const Cloth& cloth, const ClothState& state) {
  ThreadTeam team(1);
  ViscousSprings springs(cloth, team);
  Planes3 force(cloth.size);
  for (int d = 0; d < spring_directions; ++d) {
    springs.stiffness[d] = springs.viscosity[d] = cloth.springs[d].stiffness;
    for (int r = 0; r < cloth.size; ++r)
      for (int c = 0; c < cloth.size; ++c)
        springs.viscosity[d](r, c) =
            static_cast<float>(frame) * springs.stiffness[d](r, c) + cloth.springs[d].damping(r, c);
  }
  for (int r = 0; r < cloth.size; ++r) springs.gather_row(r, state, force);
  return force;
}

/// A^-1 b by V-cycles until nothing changes, A = M / h^2 + sum k; b given by own parts.
Planes3 filtered_by_cycles(const Cloth& cloth, const Planes3& b) {
  ThreadTeam team(1);
  MultigridPreconditioner filter(cloth, {frame}, team);
  std::vector<FilterLevel> levels = make_filter_levels(cloth, frame);
  Grid<float> moves(cloth.size, cloth.size, 1);
  for (const Pin& held : cloth.pins)
    for (const int s : held.copies) moves(s / cloth.size, s % cloth.size) = 0;
  renew_weights(levels, moves);
  Planes3 x(cloth.size);
  for (int cycle = 0; cycle < 60; ++cycle) {
    Planes3& right = filter.rhs();
    right = filter_residual(levels.front(), b, x);
    sum_over_mates(cloth.mates, {&right.x, &right.y, &right.z});
    for (const Pin& held : cloth.pins)
      for (const int s : held.copies) right.set(s, {});
    team.run([&](Worker& worker) { filter.cycle(worker); });
    for (int s = 0; s < cloth.size * cloth.size; ++s) x.set(s, x.at(s) + filter.value().at(s));
  }
  return x;
}

TEST(Desbrun, EqualsTheExactFilterOfTheCloth) {
  for (Cloth cloth : {sheet_cloth(13), torus_cloth(17)}) {
    pin(cloth, 0, vec_cast<double>(cloth.rest.at(0)));
    ThreadTeam team(2);
    const StepInput input{frame, {0, -9.81F, 0}};
    const auto integrator = make_integrator(DesbrunOptions{}, cloth, input, team);
    ClothState state = rest_state(cloth);
    shake(cloth, 1e-3, state.position, 1);
    shake(cloth, 0.1, state.velocity, 2);
    const Planes3 moved = filtered_by_cycles(cloth, forces_of(cloth, state));
    const ClothState before = state;
    run(*integrator, input, 1, state);
    for (int s = 1; s < cloth.size * cloth.size; ++s) {
      if (cloth.inverse_mass(s / cloth.size, s % cloth.size) == 0) continue;
      const Vec3f expected = before.velocity.at(s) + static_cast<float>(1 / frame) * moved.at(s) +
                             static_cast<float>(frame) * input.gravity;
      EXPECT_LT(length(state.velocity.at(s) - expected), 2e-4F) << "sample " << s;
    }
  }
}

TEST(Desbrun, HeldParticlesPullLikeAWall) {
  // One spring between a particle of mass m and a wall: W = m / (m + h^2 k), by hand.
  FilterGrid grid;
  grid.size = 2;
  grid.particle_of = {0, -1, 0, -1};
  grid.mass = {2};
  for (Grid<double>& plane : grid.stiffness) plane = Grid<double>(2, 2);
  grid.stiffness[stretch_u](0, 0) = 3;
  grid.time_step = 0.5;
  ThreadTeam team(1);
  const Grid<float> w = filter_matrix(grid, team);
  EXPECT_EQ(w.rows(), 1);
  EXPECT_FLOAT_EQ(w(0, 0), 2 / 2.75F);
}

TEST(Desbrun, FilteringForcesInsteadOfAccelerationsLosesMomentum) {
  // Unequal masses on a chain of springs: W keeps sum m a, its transpose M W M^-1 sum f.
  FilterGrid grid;
  grid.size = 3;
  for (int s = 0; s < 9; ++s) {
    grid.particle_of.push_back(s);
    grid.mass.push_back(1 + s);
  }
  for (Grid<double>& plane : grid.stiffness) plane = Grid<double>(3, 3, 2.0);
  grid.time_step = 1;
  ThreadTeam team(1);
  const Grid<float> w = filter_matrix(grid, team);
  double momentum = 0, filtered = 0, filtered_as_force = 0;
  for (int i = 0; i < 9; ++i) {
    const auto acceleration = [](int k) { return k % 3 - 0.5 * k; };
    momentum += grid.mass[i] * acceleration(i);
    for (int j = 0; j < 9; ++j) {
      filtered += grid.mass[i] * double{w(i, j)} * acceleration(j);
      filtered_as_force += double{w(i, j)} * grid.mass[j] * acceleration(j);
    }
  }
  EXPECT_NEAR(filtered, momentum, 1e-5 * std::abs(momentum));
  EXPECT_GT(std::abs(filtered_as_force - momentum), 0.05 * std::abs(momentum));
}

TEST(Desbrun, KeepsAngularMomentum) {
  const Cloth cloth = torus_cloth(13);
  ThreadTeam team(1);
  const StepInput input{1.0 / 240, {}};
  const auto integrator = make_integrator(DesbrunOptions{}, cloth, input, team);
  ClothState state = rest_state(cloth);
  shake(cloth, 0.005, state.position);
  run(*integrator, input, 20, state);
  const double scale = std::sqrt(2 * kinetic_energy(cloth, state) * total_mass(cloth));
  EXPECT_GT(scale, 1e-4);
  EXPECT_LT(length(angular_momentum(cloth, state)), 1e-3 * scale);
}

TEST(Desbrun, StaysBoundedHoweverStiff) {
  for (const double stretch : {2e3, 2e5}) {
    const Cloth cloth = sheet_cloth(13, {.stretch = stretch, .shear = stretch});
    ThreadTeam team(1);
    const StepInput input{frame, {}};
    const auto integrator = make_integrator(DesbrunOptions{}, cloth, input, team);
    ClothState state = rest_state(cloth);
    shake(cloth, 1e-3, state.position);
    const double start = potential_energy(cloth, state, {});
    run(*integrator, input, 200, state);
    EXPECT_LT(kinetic_energy(cloth, state) + potential_energy(cloth, state, {}), start);
    EXPECT_EQ(integrator->stability_advice(frame), "");
  }
}

TEST(Desbrun, HeedsPinsThatCome) {
  Cloth cloth = torus_cloth(9);
  ThreadTeam team(1);
  const StepInput input{frame, {0, -9.81F, 0}};
  const auto before = make_integrator(DesbrunOptions{}, cloth, input, team);
  pin(cloth, 0, vec_cast<double>(cloth.rest.at(0)));
  const auto after = make_integrator(DesbrunOptions{}, cloth, input, team);
  ClothState one = rest_state(cloth), other = one;
  run(*before, input, 10, one);
  run(*after, input, 10, other);
  EXPECT_EQ(hash_of(one), hash_of(other));
  EXPECT_EQ(one.position.at(0), cloth.rest.at(0));
}

TEST(Desbrun, RefusesWhatTakesTooMuchMemory) {
  const Cloth cloth = sheet_cloth(257);
  ThreadTeam team(1);
  try {
    make_integrator(DesbrunOptions{}, cloth, {}, team);
    FAIL() << "17 GB were taken";
  } catch (const SceneError& error) {
    EXPECT_STREQ(
        error.what(),
        "integrator.type: desbrun on 66049 particles, whose matrix takes 17450 MB; at most "
        "2147 MB, a smaller size or another integrator");
  }
}

}  // namespace
}  // namespace weft
