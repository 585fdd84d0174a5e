#include "weft/cloth/energy_meter.h"

#include <algorithm>
#include <cmath>

#include "weft/cloth/neighbours.h"
#include "weft/cloth/strain_stiffening.h"

namespace weft {

EnergyMeter::EnergyMeter(const Cloth& cloth, Vec3d gravity, ThreadTeam& team, bool stiffens)
    : cloth_(cloth),
      team_(team),
      kernels_(kernels_for(team.instructions())),
      bending_(cloth, team.instructions()),
      mass_(cloth.size, cloth.size),
      gravity_(3, cloth.size),
      axes_(2, cloth.size),
      stiffens_(stiffens),
      sums_(cloth.size) {
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) {
      mass_(r, c) = cloth.owner(r, c) * cloth.mass(r, c);
      total_mass_ += mass_(r, c);
    }
  std::fill(axes_.row(1), axes_.row(1) + cloth.size, 1.0F);
  const Vec3f g = vec_cast<float>(gravity);
  std::fill(gravity_.row(0), gravity_.row(0) + cloth.size, g.x);
  std::fill(gravity_.row(1), gravity_.row(1) + cloth.size, g.y);
  std::fill(gravity_.row(2), gravity_.row(2) + cloth.size, g.z);
}

double EnergyMeter::spring_row(const Planes3& position, int row) const {
  const int n = cloth_.size;
  const int directions = cloth_.material.bend_springs > 0 ? spring_directions : bend_u;
  double energy = 0;
  for (int d = 0; d < directions; ++d) {
    const SpringPlane& plane = cloth_.springs[d];
    if (row + plane.down >= n) continue;
    const ConstRow3 here = row_of(position, row), there = row_of(position, row + plane.down);
    const SpringRow springs{plane.rest_length.row(row), plane.stiffness.row(row), nullptr};
    energy += kernels_.spring_energy({std::max(0, -plane.right),
                                      n - std::max(0, plane.right),
                                      plane.right,
                                      0,
                                      springs,
                                      {here, here},
                                      {there, there}});
  }
  return energy + (stiffens_ ? strain_limit_energy(cloth_, position, row) : 0);
}

Energy EnergyMeter::measure(const ClothState& state) noexcept {
  Energy energy;
  const int n = cloth_.size;
  const ConstRow3 g{gravity_.row(0), gravity_.row(1), gravity_.row(2)};
  team_.run([&](Worker& worker) {
    if (bending_.active()) bending_.curve(state.position, worker);
    const double elastic = sums_.sum(
        worker, [&](int r) { return spring_row(state.position, r) + bending_.row_energy(r); });
    const double kinetic = sums_.sum(worker, [&](int r) {
      const ConstRow3 v = row_of(state.velocity, r);
      return 0.5 * kernels_.dot(n, mass_.row(r), v, v);
    });
    const double gravity = sums_.sum(worker, [&](int r) {
      return -kernels_.dot(n, mass_.row(r), row_of(state.position, r), g);
    });
    const float *none = axes_.row(0), *one = axes_.row(1);
    const auto momentum = [&](ConstRow3 axis) {
      return sums_.sum(worker, [&](int r) {
        return kernels_.dot(n, mass_.row(r), row_of(state.velocity, r), axis);
      });
    };
    const double x = momentum({one, none, none}), y = momentum({none, one, none}),
                 z = momentum({none, none, one});
    const double drift = 0.5 * (x * x + y * y + z * z) / total_mass_;
    if (worker.rank() == 0) energy = {kinetic, elastic, gravity, drift};
  });
  return energy;
}

double EnergyMeter::kinetic(const Planes3& velocity) noexcept {
  double kinetic = 0;
  team_.run([&](Worker& worker) {
    const double sum = sums_.sum(worker, [&](int r) {
      const ConstRow3 v = row_of(velocity, r);
      return 0.5 * kernels_.dot(cloth_.size, mass_.row(r), v, v);
    });
    if (worker.rank() == 0) kinetic = sum;
  });
  return kinetic;
}

double EnergyMeter::take_out(double energy, Planes3& velocity) noexcept {
  const int n = cloth_.size;
  Vec3d momentum;
  double moving = 0;
  for (int s = 0; s < n * n; ++s) {
    const double mass = mass_(s / n, s % n);
    const Vec3d v = vec_cast<double>(velocity.at(s));
    momentum += mass * v;
    moving += 0.5 * mass * squared_length(v);
  }
  const Vec3d mean = (1 / total_mass_) * momentum;
  const double aside = moving - 0.5 * total_mass_ * squared_length(mean);
  if (!(aside > 0)) return 0;
  const double taken = std::min(energy, aside), kept = std::sqrt(1 - taken / aside);
  for (int s = 0; s < n * n; ++s)
    velocity.set(s, vec_cast<float>(mean + kept * (vec_cast<double>(velocity.at(s)) - mean)));
  return taken;
}

}  // namespace weft
