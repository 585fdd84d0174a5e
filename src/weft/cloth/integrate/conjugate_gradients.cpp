#include "weft/cloth/integrate/conjugate_gradients.h"

#include <algorithm>
#include <cmath>

#include "weft/cloth/integrate/blocks.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

float dot_at(ConstRow3 a, ConstRow3 b, int c) {
  return a.x[c] * b.x[c] + a.y[c] * b.y[c] + a.z[c] * b.z[c];
}

ConstRow3 const_row_of(const Planes3& planes, int r) { return row_of(planes, r); }

}  // namespace

ConjugateGradients::ConjugateGradients(const Cloth& cloth)
    : cloth_(cloth),
      own_mass_(cloth.size, cloth.size),
      coarse_(cloth),
      direction_(cloth.size),
      image_(cloth.size),
      preconditioned_(cloth.size),
      sums_(cloth.size),
      squared_steps_(static_cast<std::size_t>(cloth.size)) {
  for (Grid<float>& plane : inverse_) plane = Grid<float>(cloth.size, cloth.size);
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) {
      own_mass_(r, c) = cloth.mass(r, c) * cloth.counted(r, c);
      total_mass_ += own_mass_(r, c);
    }
}

/// The inverses of the diagonal blocks by cofactors; zero where pinned, which filters the system.
void ConjugateGradients::invert_row(const System& system, int row) {
  std::array<const float*, 6> in{};
  std::array<float*, 6> out{};
  for (int i = 0; i < 6; ++i) {
    in[i] = system.diagonal[i].row(row);
    out[i] = inverse_[i].row(row);
  }
  const bool held = !system.contacts.empty();
  std::array<const float*, 6> contact = in;
  for (int i = 0; i < 6 && held; ++i) contact[i] = system.contacts.blocks()[i].row(row);
  const float scale = held ? 1 : 0;
  const float* inverse_mass = cloth_.inverse_mass.row(row);
#pragma omp simd
  for (int c = 0; c < cloth_.size; ++c) {
    const Symmetric3 block =
        inverse({in[0][c] + scale * contact[0][c], in[1][c] + scale * contact[1][c],
                 in[2][c] + scale * contact[2][c], in[3][c] + scale * contact[3][c],
                 in[4][c] + scale * contact[4][c], in[5][c] + scale * contact[5][c]});
    const bool moves = inverse_mass[c] > 0;
    out[0][c] = moves ? block.xx : 0.0F;
    out[1][c] = moves ? block.xy : 0.0F;
    out[2][c] = moves ? block.xz : 0.0F;
    out[3][c] = moves ? block.yy : 0.0F;
    out[4][c] = moves ? block.yz : 0.0F;
    out[5][c] = moves ? block.zz : 0.0F;
  }
}

/// Row of out = (M + S + bending + contacts) in, each sample's own part. Bending has been curved,
/// contacts multiplied by `in`.
void ConjugateGradients::apply_row(const System& system, const Planes3& in, Planes3& out,
                                   int row) const {
  system.springs.multiply_row(in, out, row);
  system.bending.add_row(-system.squared_step, row, out);
  const ConstRow3 v = row_of(in, row);
  const Row3 sum = row_of(out, row);
  const float* mass = own_mass_.row(row);
#pragma omp simd
  for (int c = 0; c < cloth_.size; ++c) {
    sum.x[c] += mass[c] * v.x[c];
    sum.y[c] += mass[c] * v.y[c];
    sum.z[c] += mass[c] * v.z[c];
  }
  if (system.contacts.loads().row(row)) system.contacts.loads().add_row(row, sum);
}

/// z = P^-1 r on a row.
void ConjugateGradients::precondition_row(const Planes3& r, int row) {
  const ConstRow3 in = row_of(r, row);
  const Row3 z = row_of(preconditioned_, row);
  std::array<const float*, 6> d{};
  for (int i = 0; i < 6; ++i) d[i] = inverse_[i].row(row);
#pragma omp simd
  for (int c = 0; c < cloth_.size; ++c) {
    const float x = in.x[c], y = in.y[c], w = in.z[c];
    z.x[c] = d[0][c] * x + d[1][c] * y + d[2][c] * w;
    z.y[c] = d[1][c] * x + d[3][c] * y + d[4][c] * w;
    z.z[c] = d[2][c] * x + d[4][c] * y + d[5][c] * w;
  }
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
    const ConstRow3 in = row_of(r, row), z = const_row_of(preconditioned_, row);
    const float* counted = cloth_.counted.row(row);
    return lane_sum(cloth_.size, [&](int c) { return double{counted[c] * dot_at(in, z, c)}; });
  });
}

/// v += alpha p, r -= alpha q on a row.
void ConjugateGradients::step_row(double alpha, Planes3& r, Planes3& v, int row) {
  const auto a = static_cast<float>(alpha);
  const ConstRow3 p = const_row_of(direction_, row), q = const_row_of(image_, row);
  const Row3 to = row_of(v, row), rest = row_of(r, row);
#pragma omp simd
  for (int c = 0; c < cloth_.size; ++c) {
    to.x[c] += a * p.x[c];
    to.y[c] += a * p.y[c];
    to.z[c] += a * p.z[c];
    rest.x[c] -= a * q.x[c];
    rest.y[c] -= a * q.y[c];
    rest.z[c] -= a * q.z[c];
  }
  float largest = 0;
  for (int c = 0; c < cloth_.size; ++c) largest = std::max(largest, dot_at(p, p, c));
  squared_steps_[row] = largest;
}

/// p = z + beta p on a row.
void ConjugateGradients::turn_row(double beta, int row) {
  const auto b = static_cast<float>(beta);
  const ConstRow3 z = const_row_of(preconditioned_, row);
  const Row3 p = row_of(direction_, row);
#pragma omp simd
  for (int c = 0; c < cloth_.size; ++c) {
    p.x[c] = z.x[c] + b * p.x[c];
    p.y[c] = z.y[c] + b * p.y[c];
    p.z[c] = z.z[c] + b * p.z[c];
  }
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
    const Row3 to = row_of(r, row);
    const ConstRow3 q = const_row_of(image_, row);
    for (int c = 0; c < cloth_.size; ++c) {
      to.x[c] -= q.x[c];
      to.y[c] -= q.y[c];
      to.z[c] -= q.z[c];
    }
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
  for (int row = mine.first; row < mine.last; ++row) turn_row(0, row);
  worker.barrier();
  SolveReport report;
  while (report.iterations < stop.max_iterations && rz > 0) {
    system.bending.curve_change(direction_, worker);
    if (!system.contacts.empty()) system.contacts.multiply(direction_, worker);
    const double pq = sums_.sum(worker, [&](int row) {
      apply_row(system, direction_, image_, row);
      const ConstRow3 p = const_row_of(direction_, row), q = const_row_of(image_, row);
      return lane_sum(cloth_.size, [&](int c) { return double{dot_at(p, q, c)}; });
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
    for (int row = mine.first; row < mine.last; ++row) turn_row(next / rz, row);
    rz = next;
    worker.barrier();
  }
  return report;
}

/// Iterations cut short leave a net impulse. With nothing held from outside the springs give none,
/// so the uniform velocity that takes it back is part of the solution.
void ConjugateGradients::restore_momentum(const Planes3& r, Planes3& v, Worker& worker) {
  const auto missing = [&](const Grid<float>& plane) {
    const double impulse = sums_.sum(worker, [&](int row) {
      const float *values = plane.row(row), *counted = cloth_.counted.row(row);
      return lane_sum(cloth_.size, [&](int c) { return double{counted[c] * values[c]}; });
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

SolveReport ConjugateGradients::solve(const System& system, const Stop& stop, Planes3& right,
                                      Planes3& v, ThreadTeam& team) {
  SolveReport report;
  // The first turn multiplies the old direction by zero, which must not keep what is not finite.
  for (Grid<float>* plane : {&direction_.x, &direction_.y, &direction_.z}) plane->fill(0);
  team.run([&](Worker& worker) {
    start(system, right, v, worker);
    const SolveReport mine = iterate(system, stop, right, v, worker);
    const bool alone = cloth_.pins.empty() && system.contacts.empty();
    if (alone && mine.iterations > 0) restore_momentum(right, v, worker);
    if (worker.rank() == 0) report = mine;
  });
  return report;
}

}  // namespace weft
