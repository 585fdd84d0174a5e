#include <cmath>
#include <utility>

#include "weft/cloth/neighbours.h"
#include "weft/cloth/newton/newton_part.h"

// Energies of a cloth in a step, and the removal of excess energy from its velocities.
namespace weft {

double NewtonPart::bending_energy(const PaddedVectors& position, Worker& worker) {
  if (!curved_.active()) return multigrid_.bending_energy(position, sums_, share_, worker);
  take_plain(position, worker);
  curved_.set_position(plain_, worker);
  return sums_.sum(worker, [&](int r) { return r == 0 ? curved_.energy() : 0.0; });
}

double NewtonPart::step_energy(Worker& worker) {
  const Vec3f gained = static_cast<float>(input_.time_step) * input_.gravity;
  const double inner = sums_.sum(worker, [&](int r) {
    const float* mass = own_mass_.row(r);
    const ConstRow3 v = std::as_const(state_.velocity).row(r),
                    v0 = row_of(std::as_const(start_velocity_), r);
    return springs_.damped_energy_row(state_, r) + lane_sum(cloth_.size, [&](int c) {
             const double x = v.x[c] - v0.x[c] - gained.x, y = v.y[c] - v0.y[c] - gained.y,
                          z = v.z[c] - v0.z[c] - gained.z;
             return 0.5 * mass[c] * (x * x + y * y + z * z);
           });
  });
  return inner + bending_energy(state_.position, worker);
}

double NewtonPart::potential_at(const PaddedVectors& position, Worker& worker) {
  const Vec3f g = input_.gravity;
  const double springs_and_gravity = sums_.sum(worker, [&](int r) {
    const float* mass = own_mass_.row(r);
    const ConstRow3 x = position.row(r);
    return springs_.energy_row(position, r) - lane_sum(cloth_.size, [&](int c) {
             return double{mass[c]} * (double{g.x} * double{x.x[c]} + double{g.y} * double{x.y[c]} +
                                       double{g.z} * double{x.z[c]});
           });
  });
  return springs_and_gravity + bending_energy(position, worker);
}

double NewtonPart::potential(Worker& worker) {
  const double now = potential_at(state_.position, worker);
  worker.barrier();
  if (worker.rank() == 0) potential_ = now;
  return now;
}

double NewtonPart::start_potential(Worker& worker) {
  worker.barrier();
  const double known = start_potential_;
  if (known < HUGE_VAL) return known;
  const double found = potential_at(state_.start, worker);
  worker.barrier();
  if (worker.rank() == 0) start_potential_ = found;
  return found;
}

void NewtonPart::forget_potential(Worker& worker) {
  worker.barrier();
  if (worker.rank() == 0) potential_ = HUGE_VAL;
}

template <class Velocity>
double NewtonPart::kinetic_of(const Velocity& row_of_velocity, Worker& worker) {
  return sums_.sum(worker, [&](int r) {
    const ConstRow3 v = row_of_velocity(r);
    return 0.5 * kernels_.dot(whole_vectors(cloth_.size), own_mass_.row(r), v, v);
  });
}

double NewtonPart::start_kinetic(Worker& worker) {
  return kinetic_of([&](int r) { return row_of(std::as_const(start_velocity_), r); }, worker);
}

double NewtonPart::kinetic(Worker& worker) {
  return kinetic_of([&](int r) { return std::as_const(state_.velocity).row(r); }, worker);
}

template <class Velocity>
double NewtonPart::kinetic_of(const Velocity& row_of_velocity, Vec3d beside, Worker& worker) {
  return sums_.sum(worker, [&](int r) {
    const ConstRow3 v = row_of_velocity(r);
    const float *mass = own_mass_.row(r), *free = multigrid_.mask().row(r);
    return 0.5 * lane_sum(cloth_.size, [&](int c) {
             const double x = v.x[c] - beside.x, y = v.y[c] - beside.y, z = v.z[c] - beside.z;
             return double{free[c]} * mass[c] * (x * x + y * y + z * z);
           });
  });
}

double NewtonPart::start_kinetic_beside(Vec3d velocity, Worker& worker) {
  return kinetic_of([&](int r) { return row_of(std::as_const(start_velocity_), r); }, velocity,
                    worker);
}

double NewtonPart::kinetic_beside(Vec3d velocity, Worker& worker) {
  return kinetic_of([&](int r) { return std::as_const(state_.velocity).row(r); }, velocity, worker);
}

double NewtonPart::inner_kinetic(Worker& worker) {
  const PaddedVectors& v = state_.velocity;
  const PaddedPlane* const planes[3] = {&v.x, &v.y, &v.z};
  double mean[3], mean_energy = 0;
  for (int k = 0; k < 3; ++k) {
    mean[k] = sums_.sum(worker, [&](int r) {
      const float *mass = own_mass_.row(r), *speed = planes[k]->row(r),
                  *free = multigrid_.mask().row(r);
      return lane_sum(cloth_.size,
                      [&](int c) { return double{free[c]} * mass[c] * double{speed[c]}; });
    });
    mean[k] /= mass_;
    mean_energy += 0.5 * mass_ * mean[k] * mean[k];
  }
  if (worker.rank() == 0) mean_velocity_ = {mean[0], mean[1], mean[2]};
  return kinetic(worker) - mean_energy;
}

void NewtonPart::calm(double left, Worker& worker) {
  PaddedVectors& v = state_.velocity;
  PaddedPlane* const planes[3] = {&v.x, &v.y, &v.z};
  const double mean[3] = {mean_velocity_.x, mean_velocity_.y, mean_velocity_.z};
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r)
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < cloth_.size; ++c)
        if (multigrid_.mask()(r, c) > 0) {
          float& speed = (*planes[k])(r, c);
          speed = static_cast<float>(mean[k] + left * (double{speed} - mean[k]));
        }
  worker.barrier();
}

}  // namespace weft
