#pragma once

#include "tests/cloth/sheets.h"
#include "weft/cloth/newton/block_multigrid.h"

namespace weft::testing {

constexpr double step = 1.0 / 240;

/// True cotton, light and stiff cloth, and one with warp and weft.
inline const Material cotton{.density = 0.15, .stretch = 20000, .shear = 100, .bending = 1.2e-5};
inline const Material hard{
    .density = 0.02, .stretch = 100000, .shear = 20, .bending = 1e-5, .damping = 0};
inline const Material woven{
    .density = 0.1, .stretch = {30000, 9000}, .shear = 60, .bending = {2e-5, 4e-6}, .damping = 1};

/// Pins both corners of the first row where they are.
inline void hang(Cloth& cloth) {
  for (const int s : {0, cloth.size - 1}) pin(cloth, s, vec_cast<double>(cloth.rest.at(s)));
}

inline Planes3 shaken_rest(const Cloth& cloth, double amount) {
  Planes3 at = cloth.rest;
  shake(cloth, amount, at);
  return at;
}

/// A linear system as a step meets it: springs linearised at a shaken state.
struct System {
  explicit System(const Cloth& of, double shaken = 0.2)
      : System(of, shaken_rest(of, shaken * of.rest_spacing)) {}
  System(const Cloth& of, const Planes3& at)
      : cloth(of),
        springs(of, kernels),
        multigrid(of, 1, kernels),
        state(of.size),
        scratch(of.size, of.size) {
    for (int r = 0; r < of.size; ++r)
      for (int c = 0; c < of.size; ++c) {
        const Vec3f p = at.at(r, c);
        state.position.x(r, c) = state.start.x(r, c) = p.x;
        state.position.y(r, c) = state.start.y(r, c) = p.y;
        state.position.z(r, c) = state.start.z(r, c) = p.z;
      }
    springs.set_time_step(step);
    team.run([&](Worker& worker) {
      multigrid.linearise({state, Planes3(of.size), {}, 0.1F}, nullptr, springs, scratch, worker);
      for (int r = 0; r < of.size; ++r) multigrid.fill_diagonals(springs, r);
      multigrid.set_up(springs, worker);
    });
  }
  PaddedVectors random_field(int seed) const {
    Random random(static_cast<std::uint64_t>(seed));
    Planes3 planes(cloth.size);
    shake(cloth, 1, planes, seed);
    PaddedVectors field(cloth.size, cloth.size);
    for (int r = 0; r < cloth.size; ++r)
      for (int c = 0; c < cloth.size; ++c) {
        if (cloth.inverse_mass(r, c) == 0) continue;
        field.x(r, c) = planes.x(r, c);
        field.y(r, c) = planes.y(r, c);
        field.z(r, c) = planes.z(r, c);
      }
    return field;
  }
  double dot(const PaddedVectors& a, const PaddedVectors& b) const {
    double sum = 0;
    for (int r = 0; r < cloth.size; ++r)
      for (int c = 0; c < cloth.size; ++c)
        if (cloth.owner(r, c) > 0)
          sum += double{a.x(r, c)} * b.x(r, c) + double{a.y(r, c)} * b.y(r, c) +
                 double{a.z(r, c)} * b.z(r, c);
    return sum;
  }
  void times(const PaddedVectors& x, PaddedVectors& out) {
    team.run([&](Worker& worker) { multigrid.apply(x, {}, out, worker); });
  }
  const PaddedVectors& cycle(const PaddedVectors& rhs) {
    for (int r = 0; r < cloth.size; ++r)
      for (int c = 0; c < cloth.size; ++c) {
        multigrid.rhs().x(r, c) = rhs.x(r, c);
        multigrid.rhs().y(r, c) = rhs.y(r, c);
        multigrid.rhs().z(r, c) = rhs.z(r, c);
      }
    team.run([&](Worker& worker) { multigrid.cycle(worker); });
    return multigrid.value();
  }
  /// Iterations of preconditioned conjugate gradients to a hundredth of the error's energy norm.
  int iterations_to_a_hundredth() {
    const int n = cloth.size;
    const PaddedVectors solution = random_field(5);
    PaddedVectors residual(n, n), direction(n, n), product(n, n), error = random_field(5);
    times(solution, residual);
    const double first = dot(solution, residual);
    double curvature = 0;
    for (int i = 1; i < 60; ++i) {
      const PaddedVectors& z = cycle(residual);
      const double slope = dot(residual, z);
      const double overlap = curvature > 0 ? dot(product, z) / curvature : 0;
      blend(1, z, static_cast<float>(-overlap), direction);
      times(direction, product);
      curvature = dot(direction, product);
      const auto length = static_cast<float>(slope / curvature);
      blend(-length, product, 1, residual);
      blend(-length, direction, 1, error);
      times(error, product);
      if (dot(error, product) < 1e-4 * first) return i;
    }
    return 60;
  }
  /// b = p a + q b
  void blend(float p, const PaddedVectors& a, float q, PaddedVectors& b) const {
    for (int r = 0; r < cloth.size; ++r)
      for (int c = 0; c < cloth.size; ++c) {
        b.x(r, c) = p * a.x(r, c) + q * b.x(r, c);
        b.y(r, c) = p * a.y(r, c) + q * b.y(r, c);
        b.z(r, c) = p * a.z(r, c) + q * b.z(r, c);
      }
  }

  const Cloth& cloth;
  ThreadTeam team{1};
  const NewtonKernels& kernels = newton_kernels_for(team.instructions());
  SpringHessian springs;
  BlockMultigrid multigrid;
  PaddedState state;
  PaddedVectors scratch;
};

}  // namespace weft::testing
