#include "weft/cloth/strain_limit.h"

#include <cmath>

#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

// Springs between interior samples are limited in eight colours: each of the four directions in
// two, such that no two springs of a colour share a particle. Springs with an end on the border
// join classes of mates in ways that no such colouring knows, and they are few: one worker takes
// them in their order, on the representatives, once the colours of a pass are done.

namespace weft {
namespace {

/// How far the first end of a spring moves along (dx, dy, dz) per unit of its inverse mass.
inline float correction(float squared, float rest, float inverse_masses,
                        const StrainBounds& bounds) {
  const float length = std::sqrt(squared);
  const float low = rest * bounds.shortest, high = rest * bounds.longest;
  const float wanted = length > high ? high : (length < low ? low : length);
  const float shift = (length - wanted) / (length * inverse_masses);
  return squared > 0 && inverse_masses > 0 ? shift : 0.0F;
}

/// The rows that a run of springs joins: row `here` at column c with row `there` at column c +
/// shift.
struct JoinedRows {
  Row3 here, there, here_velocity, there_velocity;
  const float *here_inverse_mass, *there_inverse_mass, *rest;
  int shift, first, last;
};

JoinedRows join(const Cloth& cloth, const SpringPlane& springs, ClothState& state, int row) {
  const int other = row + springs.down;
  return {row_of(state.position, row),  row_of(state.position, other),
          row_of(state.velocity, row),  row_of(state.velocity, other),
          cloth.inverse_mass.row(row),  cloth.inverse_mass.row(other),
          springs.rest_length.row(row), springs.right,
          springs.right < 0 ? 2 : 1,    springs.right > 0 ? cloth.size - 2 : cloth.size - 1};
}

/// StrainBounds every Step-th spring of a run from column `first` on: none shares a particle with
/// another.
template <int Step>
void limit_run(const JoinedRows& rows, int first, const StrainBounds& bounds) {
  const int shift = rows.shift;
#pragma omp simd
  for (int c = first; c < rows.last; c += Step) {
    const int d = c + shift;
    const float dx = rows.there.x[d] - rows.here.x[c];
    const float dy = rows.there.y[d] - rows.here.y[c];
    const float dz = rows.there.z[d] - rows.here.z[c];
    const float wi = rows.here_inverse_mass[c], wj = rows.there_inverse_mass[d];
    const float s = correction(dx * dx + dy * dy + dz * dz, rows.rest[c], wi + wj, bounds);
    const float si = s * wi, sj = s * wj;
    const float vi = si * bounds.inverse_step, vj = sj * bounds.inverse_step;
    rows.here.x[c] += si * dx;
    rows.here.y[c] += si * dy;
    rows.here.z[c] += si * dz;
    rows.there.x[d] -= sj * dx;
    rows.there.y[d] -= sj * dy;
    rows.there.z[d] -= sj * dz;
    rows.here_velocity.x[c] += vi * dx;
    rows.here_velocity.y[c] += vi * dy;
    rows.here_velocity.z[c] += vi * dz;
    rows.there_velocity.x[d] -= vj * dx;
    rows.there_velocity.y[d] -= vj * dy;
    rows.there_velocity.z[d] -= vj * dz;
  }
}

/// One colour of the springs between interior samples: along rows by column parity, else by row
/// parity.
void limit_colour(const Cloth& cloth, SpringDirection direction, int parity,
                  const StrainBounds& bounds, ClothState& state, Worker& worker) {
  const SpringPlane& springs = cloth.springs[direction];
  const int interior = cloth.size - 2 - springs.down;
  const bool by_column = springs.down == 0;
  const Range mine = worker.share(by_column ? interior : (interior + 1 - parity) / 2);
  for (int i = mine.first; i < mine.last; ++i) {
    const JoinedRows rows = join(cloth, springs, state, 1 + (by_column ? i : 2 * i + parity));
    if (by_column)
      limit_run<2>(rows, rows.first + parity, bounds);
    else
      limit_run<1>(rows, rows.first, bounds);
  }
}

void limit_border(const Cloth& cloth, const StrainBounds& bounds, ClothState& state) {
  const int n = cloth.size;
  for (const BorderSpring& spring : cloth.border_springs) {
    const Vec3f xi = state.position.at(spring.from), xj = state.position.at(spring.to);
    const float wi = cloth.inverse_mass(spring.from / n, spring.from % n);
    const float wj = cloth.inverse_mass(spring.to / n, spring.to % n);
    const Vec3f d = xj - xi;
    const float s = correction(dot(d, d), spring.rest_length, wi + wj, bounds);
    if (s == 0) continue;
    const Vec3f vi = state.velocity.at(spring.from), vj = state.velocity.at(spring.to);
    state.position.set(spring.from, xi + s * wi * d);
    state.position.set(spring.to, xj - s * wj * d);
    state.velocity.set(spring.from, vi + s * wi * bounds.inverse_step * d);
    state.velocity.set(spring.to, vj - s * wj * bounds.inverse_step * d);
  }
}

}  // namespace

void limit_pass(const Cloth& cloth, const StrainBounds& bounds, ClothState& state,
                Worker& worker) noexcept {
  for (const SpringDirection direction : {stretch_u, stretch_v, shear_1, shear_2})
    for (const int parity : {0, 1}) {
      limit_colour(cloth, direction, parity, bounds, state, worker);
      worker.barrier();
    }
  if (worker.rank() == 0) limit_border(cloth, bounds, state);
  worker.barrier();
}

void limit_strain(const Cloth& cloth, const LimitOptions& options, double time_step,
                  ClothState& state, ThreadTeam& team) noexcept {
  if (cloth.material.strain_limit <= 0 || options.passes <= 0) return;
  const auto elongation = static_cast<float>(cloth.material.strain_limit);
  const StrainBounds bounds{1 - elongation, 1 + elongation, static_cast<float>(1 / time_step)};
  team.run([&](Worker& worker) {
    for (int pass = 0; pass < options.passes; ++pass) limit_pass(cloth, bounds, state, worker);
    copy_to_mates(cloth.mates, worker,
                  {&state.position.x, &state.position.y, &state.position.z, &state.velocity.x,
                   &state.velocity.y, &state.velocity.z});
  });
}

}  // namespace weft
