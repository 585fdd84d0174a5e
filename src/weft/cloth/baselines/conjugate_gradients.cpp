#include "weft/cloth/baselines/conjugate_gradients.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

ConstRow3 const_row_of(const Planes3& planes, int r) { return row_of(planes, r); }

}  // namespace

ConjugateGradients::ConjugateGradients(const Cloth& cloth, InstructionSet instructions)
    : cloth_(cloth),
      table_(kernels_for(instructions)),
      kernels_(implicit_kernels_for(instructions)),
      own_mass_(cloth.size, cloth.size),
      coarse_(cloth, instructions),
      direction_(cloth.size),
      image_(cloth.size),
      preconditioned_(cloth.size),
      sums_(cloth.size),
      squared_steps_(static_cast<std::size_t>(cloth.size)) {
  for (Grid<float>& plane : inverse_) plane = Grid<float>(cloth.size, cloth.size);
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) {
      own_mass_(r, c) = cloth.mass(r, c) * cloth.owner(r, c);
      total_mass_ += own_mass_(r, c);
    }
}

/// The inverses of the diagonal blocks; zero where pinned, which filters the system.
void ConjugateGradients::invert_row(const System& system, int row) {
  const bool held = !system.contacts.empty();
  const BlockRow own = row_of(system.diagonal, row);
  kernels_.invert_blocks(cloth_.size,
                         {own, held ? row_of(system.contacts.blocks(), row) : own, nullptr,
                          cloth_.inverse_mass.row(row), 1, held ? 1.0F : 0.0F, 0},
                         row_of(inverse_, row));
}

/// A row of out = (M + S + bending + contacts) in, each sample's own part. Requires the
/// curve_change of bending and the product of the contacts for `in`.
void ConjugateGradients::apply_row(const System& system, const Planes3& in, Planes3& out,
                                   int row) const {
  system.springs.multiply_row(in, out, row);
  system.bending.add_row(-system.squared_step, row, out);
  const Row3 sum = row_of(out, row);
  kernels_.add_mass(cloth_.size, own_mass_.row(row), row_of(in, row), sum);
  if (system.contacts.loads().row(row)) system.contacts.loads().add_row(row, sum);
}

/// z = P^-1 r on a row.
void ConjugateGradients::precondition_row(const Planes3& r, int row) {
  table_.apply_blocks(cloth_.size, 1, row_of(std::as_const(inverse_), row), row_of(r, row),
                      row_of(preconditioned_, row));
  if (!coarse_.empty()) coarse_.add_row(preconditioned_, row);
}

/// z = P^-1 r. @return r . z, particles counted once
double ConjugateGradients::precondition(const Planes3& r, Worker& worker) {
  if (!coarse_.empty()) coarse_.solve(r, worker);
  const bool apart = coarse_.parts_mates();
  if (apart) {
    const Range mine = worker.share(cloth_.size);
    for (int row = mine.first; row < mine.last; ++row) precondition_row(r, row);
    worker.barrier();
    Planes3& z = preconditioned_;
    average_over_mates(cloth_.mates, worker, {&z.x, &z.y, &z.z});
    worker.barrier();
  }
  return sums_.sum(worker, [&](int row) {
    if (!apart) precondition_row(r, row);
    return table_.dot(cloth_.size, cloth_.owner.row(row), row_of(r, row),
                      const_row_of(preconditioned_, row));
  });
}

/// v += alpha p, r -= alpha q on a row.
void ConjugateGradients::step_row(double alpha, Planes3& r, Planes3& v, int row) {
  squared_steps_[row] = kernels_.gradient_step(
      cloth_.size, {static_cast<float>(alpha), const_row_of(direction_, row),
                    const_row_of(image_, row), row_of(r, row), row_of(v, row)});
}

/// p = z + beta p on a row.
void ConjugateGradients::update_direction_row(double beta, int row) {
  kernels_.update_direction(cloth_.size, static_cast<float>(beta),
                            const_row_of(preconditioned_, row), row_of(direction_, row));
}

double ConjugateGradients::largest_step() const {
  return std::sqrt(*std::max_element(squared_steps_.begin(), squared_steps_.end()));
}

/// Turns the right side into the residual of the guess, summed over mates.
void ConjugateGradients::start(const System& system, Planes3& r, const Planes3& v, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  system.bending.curve_change(v, worker);
  if (!system.contacts.empty()) system.contacts.multiply(v, worker);
  for (int row = mine.first; row < mine.last; ++row) {
    invert_row(system, row);
    apply_row(system, v, image_, row);
    kernels_.subtract(cloth_.size, const_row_of(image_, row), row_of(r, row));
  }
  worker.barrier();
  sum_over_mates(cloth_.mates, worker, {&r.x, &r.y, &r.z});
  worker.barrier();
  if (!coarse_.empty()) coarse_.prepare(system.diagonal, system.contacts, worker);
}

SolveReport ConjugateGradients::iterate(const System& system, const Stop& stop, Planes3& r,
                                        Planes3& v, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  double rz = precondition(r, worker);
  for (int row = mine.first; row < mine.last; ++row) update_direction_row(0, row);
  worker.barrier();
  SolveReport report;
  while (report.iterations < stop.max_iterations && rz > 0) {
    system.bending.curve_change(direction_, worker);
    if (!system.contacts.empty()) system.contacts.multiply(direction_, worker);
    const double pq = sums_.sum(worker, [&](int row) {
      apply_row(system, direction_, image_, row);
      return table_.dot(cloth_.size, nullptr, const_row_of(direction_, row),
                        const_row_of(image_, row));
    });
    if (!(pq > 0)) break;
    sum_over_mates(cloth_.mates, worker, {&image_.x, &image_.y, &image_.z});
    worker.barrier();
    const double alpha = rz / pq;
    for (int row = mine.first; row < mine.last; ++row) step_row(alpha, r, v, row);
    worker.barrier();
    ++report.iterations;
    report.correction = alpha * largest_step();
    if (report.correction < stop.correction) break;
    const double next = precondition(r, worker);
    for (int row = mine.first; row < mine.last; ++row) update_direction_row(next / rz, row);
    rz = next;
    worker.barrier();
  }
  return report;
}

/// Removes the net impulse that truncated iterations leave. Without pins and contacts the internal
/// forces have none, so the uniform velocity that removes it is part of the solution.
void ConjugateGradients::restore_momentum(const Planes3& r, Planes3& v, Worker& worker) {
  const auto missing = [&](const Grid<float>& plane) {
    const double impulse = sums_.sum(worker, [&](int row) {
      const float *values = plane.row(row), *owner = cloth_.owner.row(row);
      return lane_sum(cloth_.size, [&](int c) { return double{owner[c] * values[c]}; });
    });
    return static_cast<float>(impulse / total_mass_);
  };
  const Vec3f shift{missing(r.x), missing(r.y), missing(r.z)};
  const Range mine = worker.share(cloth_.size);
  for (int row = mine.first; row < mine.last; ++row) {
    const Row3 to = row_of(v, row);
    for (int c = 0; c < cloth_.size; ++c) {
      to.x[c] += shift.x;
      to.y[c] += shift.y;
      to.z[c] += shift.z;
    }
  }
}

SolveReport ConjugateGradients::solve(const System& system, const Stop& stop, Planes3& rhs,
                                      Planes3& v, ThreadTeam& team) {
  SolveReport report;
  // The first update multiplies the old direction by zero, which would keep values that are not
  // finite.
  for (Grid<float>* plane : {&direction_.x, &direction_.y, &direction_.z}) plane->fill(0);
  team.run([&](Worker& worker) {
    start(system, rhs, v, worker);
    const SolveReport mine = iterate(system, stop, rhs, v, worker);
    const bool alone = cloth_.pins.empty() && system.contacts.empty();
    if (alone && mine.iterations > 0) restore_momentum(rhs, v, worker);
    if (worker.rank() == 0) report = mine;
  });
  return report;
}

}  // namespace weft
