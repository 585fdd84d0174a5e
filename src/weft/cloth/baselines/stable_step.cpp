#include "weft/cloth/baselines/stable_step.h"

#include <algorithm>
#include <cmath>

#include "weft/cloth/baselines/spring_matrix.h"
#include "weft/cloth/bending.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"
#include "weft/core/ordered_sum.h"
#include "weft/core/random.h"

namespace weft {
namespace {

/// A random start vector with a part in every mode; mates equal, pins 0.
Planes3 random_motion(const Cloth& cloth) {
  Planes3 v(cloth.size);
  Random random(1);
  for (Grid<float>* plane : {&v.x, &v.y, &v.z})
    for (int r = 0; r < cloth.size; ++r)
      for (int c = 0; c < cloth.size; ++c)
        (*plane)(r, c) = static_cast<float>(random.uniform(-1, 1));
  ThreadTeam alone(1);
  alone.run([&](Worker& worker) { copy_to_mates(cloth.mates, worker, {&v.x, &v.y, &v.z}); });
  for (int sample = 0; sample < cloth.size * cloth.size; ++sample)
    if (cloth.inverse_mass(sample / cloth.size, sample % cloth.size) == 0) v.set(sample, {});
  return v;
}

/// K, the stiffness matrix at rest.
struct Stiffness {
  SpringMatrix springs;
  BendingPass bending;
};

/// One power iteration, v <- M^-1 K v / |M^-1 K v| on this worker's rows. @return |M^-1 K v|
double iterate_power(const Cloth& cloth, Stiffness& stiffness, Planes3& v, Planes3& kv,
                     RowSums& sums, Worker& worker) {
  const Range mine = worker.share(cloth.size);
  stiffness.bending.curve_change(v, worker);
  for (int r = mine.first; r < mine.last; ++r) {
    stiffness.springs.multiply_row(v, kv, r);
    stiffness.bending.add_row(-1, r, kv);
  }
  worker.barrier();
  sum_over_mates(cloth.mates, worker, {&kv.x, &kv.y, &kv.z});
  worker.barrier();
  const double squared = sums.sum(worker, [&](int r) {
    const Row3 row = row_of(kv, r);
    const float* inverse_mass = cloth.inverse_mass.row(r);
    for (int c = 0; c < cloth.size; ++c) {
      row.x[c] *= inverse_mass[c];
      row.y[c] *= inverse_mass[c];
      row.z[c] *= inverse_mass[c];
    }
    return lane_sum(cloth.size, [&](int c) {
      const double x = row.x[c], y = row.y[c], z = row.z[c];
      return cloth.owner(r, c) * (x * x + y * y + z * z);
    });
  });
  const double norm = std::sqrt(squared);
  const auto scale = static_cast<float>(norm > 0 ? 1 / norm : 0);
  for (int r = mine.first; r < mine.last; ++r) {
    const Row3 to = row_of(v, r);
    const Row3 from = row_of(kv, r);
    for (int c = 0; c < cloth.size; ++c) {
      to.x[c] = scale * from.x[c];
      to.y[c] = scale * from.y[c];
      to.z[c] = scale * from.z[c];
    }
  }
  worker.barrier();
  return norm;
}

/// The square of the highest frequency about the rest shape [1/s^2].
double highest_squared_frequency(const Cloth& cloth, ThreadTeam& team) {
  constexpr int iterations = 200;
  Cloth undamped = cloth;
  for (SpringPlane& plane : undamped.springs) plane.damping.fill(0);
  Stiffness stiffness{SpringMatrix(undamped), BendingPass(cloth)};
  for (int r = 0; r < cloth.size; ++r) stiffness.springs.linearise_row(cloth.rest, 1, r);
  Planes3 v = random_motion(cloth), kv(cloth.size);
  RowSums sums(cloth.size);
  double result = 0;
  team.run([&](Worker& worker) {
    double norm = 0;
    stiffness.bending.curve(cloth.rest, worker);
    for (int i = 0; i < iterations; ++i)
      norm = iterate_power(cloth, stiffness, v, kv, sums, worker);
    if (worker.rank() == 0) result = norm;
  });
  return result;
}

/// The largest, over all particles, of twice the sum of `coefficient` over a particle's edges, over
/// its mass.
template <class Coefficient>
double largest_sum(const Cloth& cloth, const Coefficient& coefficient) {
  Planes3 sum(cloth.size);
  for (int d = 0; d < spring_directions; ++d) {
    const Grid<float> edges = coefficient(static_cast<SpringDirection>(d));
    for (int r = 0; r < cloth.size; ++r)
      for (const NeighbourRow& to : NeighbourRows(cloth.size, r))
        for (int c = to.first; to.direction == d && c < to.last; ++c)
          sum.x(r, c) += edges(to.spring_row, c + to.spring_shift);
  }
  ThreadTeam alone(1);
  alone.run([&](Worker& worker) { sum_over_mates(cloth.mates, worker, {&sum.x}); });
  double bound = 0;
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c)
      bound = std::max(bound, 2.0 * sum.x(r, c) * cloth.inverse_mass(r, c));
  return bound;
}

/// A bound of the damping rate [1/s].
double damping_bound(const Cloth& cloth) {
  return largest_sum(cloth, [&](SpringDirection d) { return cloth.springs[d].damping; });
}

}  // namespace

double largest_stable_step(const Cloth& cloth, ThreadTeam& team) {
  const double w2 = highest_squared_frequency(cloth, team);
  const double c = damping_bound(cloth);
  if (w2 <= 0) return c > 0 ? 2 / c : HUGE_VAL;
  return (std::sqrt(c * c + 4 * w2) - c) / w2;
}

bool is_surely_stable(const Cloth& cloth, double time_step) {
  const double c = damping_bound(cloth);
  const double w2 =
      largest_sum(cloth, [&](SpringDirection d) { return cloth.springs[d].stiffness; }) +
      largest_sum(cloth, [&](SpringDirection d) { return bending_bound(cloth, d); });
  return time_step * time_step * w2 + 2 * time_step * c < 4;
}

}  // namespace weft
