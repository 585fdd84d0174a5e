#include "weft/cloth/baselines/safe_velocities.h"

#include <algorithm>

#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// @param linear, squared  b and 2 a of the change
double safe_part(double linear, double squared) {
  return squared > 0 ? std::clamp(-2 * linear / squared, 0.0, 1.0) : 0;
}

void add_row(ConstRow3 from, float factor, int n, Row3 to) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    to.x[c] += factor * from.x[c];
    to.y[c] += factor * from.y[c];
    to.z[c] += factor * from.z[c];
  }
}

}  // namespace

SafeVelocities::SafeVelocities(const Cloth& cloth, const ThreadTeam& team)
    : cloth_(cloth),
      kernels_(kernels_for(team.instructions())),
      own_mass_(cloth.size, cloth.size),
      sums_(cloth.size) {
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) own_mass_(r, c) = cloth.mass(r, c) * cloth.owner(r, c);
}

double SafeVelocities::add(const Planes3& change, double scale, Planes3& velocity, Worker& worker) {
  const int n = cloth_.size;
  const auto product = [&](const Planes3& other) {
    return sums_.sum(worker, [&](int row) {
      return kernels_.dot(n, own_mass_.row(row), row_of(change, row), row_of(other, row));
    });
  };
  const double linear = scale * product(velocity);
  const double part = safe_part(linear, scale * scale * product(change));
  // The sums have been waited for: nobody reads velocities any more.
  const Range mine = worker.share(n);
  for (int row = mine.first; part > 0 && row < mine.last; ++row)
    add_row(row_of(change, row), static_cast<float>(part * scale), n, row_of(velocity, row));
  return part;
}

}  // namespace weft
