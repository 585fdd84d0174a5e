#include "weft/cloth/newton/spring_hessian.h"

#include <algorithm>
#include <utility>

#include "weft/cloth/neighbours.h"

namespace weft {

Passing RowSweep::passing(int row) {
  next_ = row + 1;
  return {std::as_const(carried_).row(row & 1), carried_.row(1 - (row & 1))};
}

void RowSweep::start(int row) {
  clear_row(carried_.row(row & 1), whole_vectors(carried_.x.cols()));
  next_ = row;
}

SpringHessian::SpringHessian(const Cloth& cloth, const NewtonKernels& kernels)
    : cloth_(cloth),
      kernels_(&kernels),
      directions_(cloth.material.bend_springs > 0 ? int{spring_directions} : near_directions),
      constants_(cloth.size, cloth.size, near_directions * spring_constants),
      near_(cloth.size, cloth.size, near_directions * spring_entries),
      inertia_(cloth.size, cloth.size),
      momentum_(cloth.size, cloth.size) {
  const int n = cloth.size;
  for (int d = 0; d < near_directions; ++d)
    for (int r = 0; r < n; ++r) {
      const SpringPlane& springs = cloth.springs[d];
      std::copy_n(springs.rest_length.row(r), n, constants_.row(r, d * spring_constants));
      std::copy_n(springs.stiffness.row(r), n, constants_.row(r, d * spring_constants + 1));
      std::copy_n(springs.damping.row(r), n, constants_.row(r, d * spring_constants + 2));
    }
  for (int d = near_directions; d < directions_; ++d) {
    Direction& one = far_[d - near_directions];
    for (PaddedPlane* plane : {&one.t, &one.x, &one.y, &one.z, &one.f}) *plane = PaddedPlane(n, n);
  }
}

void SpringHessian::set_time_step(double time_step) {
  if (time_step == time_step_) return;
  time_step_ = time_step;
  const auto h = static_cast<float>(time_step);
  for (int r = 0; r < cloth_.size; ++r)
    for (int c = 0; c < cloth_.size; ++c) {
      momentum_(r, c) = cloth_.mass(r, c) / h;
      inertia_(r, c) = cloth_.mass(r, c) / (h * h);
    }
  for (int i = 0; i < cloth_.mates.class_count(); ++i) {
    const float share = 1 / static_cast<float>(cloth_.mates.copies(i).size());
    for (const int s : cloth_.mates.mates(i)) {
      const float part = cloth_.mates.is_hole(s) ? 0 : share;
      momentum_(s / cloth_.size, s % cloth_.size) *= part;
      inertia_(s / cloth_.size, s % cloth_.size) *= part;
    }
  }
}

/// Without velocities and start positions.
LinearisedSprings SpringHessian::far_at(int direction, const PaddedVectors& position,
                                        int row) const {
  const SpringPlane& springs = cloth_.springs[direction];
  const ConstRow3 here = position.row(row);
  return {springs.rest_length.row(row),
          springs.stiffness.row(row),
          springs.damping.row(row),
          here,
          shifted(position.row(row + springs.down), springs.right),
          here,
          here,
          here,
          here,
          static_cast<float>(1 / time_step_),
          0,
          0,
          1,
          0};
}

NearSprings SpringHessian::near_at(const PaddedState& state, int row) const {
  const auto limit = static_cast<float>(cloth_.material.strain_limit);
  const auto pair = [&](const PaddedVectors& field) {
    return RowPair{field.row(row), field.row(row + 1)};
  };
  return {rows_of(constants_, row),
          pair(state.position),
          pair(state.velocity),
          pair(state.start),
          static_cast<float>(1 / time_step_),
          0,
          0,
          1 + limit,
          limit > 0 ? strain_limit_factor : 0.0F};
}

void SpringHessian::linearise_far_row(const Point& point, int row) {
  for (int d = near_directions; d < directions_; ++d) {
    LinearisedSprings springs = far_at(d, point.at.position, row);
    const SpringPlane& plane = cloth_.springs[d];
    springs.speed_here = point.at.velocity.row(row);
    springs.speed_there = shifted(point.at.velocity.row(row + plane.down), plane.right);
    springs.guessed_share = point.guessed_share;
    springs.start_here = point.at.start.row(row);
    springs.start_there = shifted(point.at.start.row(row + plane.down), plane.right);
    Direction& out = far_[d - near_directions];
    kernels_->linearise_far(
        cloth_.size, springs,
        {out.t.row(row), out.x.row(row), out.y.row(row), out.z.row(row), out.f.row(row)});
  }
}

void SpringHessian::linearise_row(const Point& point, int row, RowSweep& sweep,
                                  PaddedVectors& force) {
  const auto linearise = [&](int r, MutablePlaneRows hessian, Row3 out) {
    NearSprings springs = near_at(point.at, r);
    springs.guessed_share = point.guessed_share;
    kernels_->linearise(whole_vectors(cloth_.size), springs,
                        {momentum_.row(r),
                         point.at.velocity.row(r),
                         row_of(point.start_velocity, r),
                         {point.gained.x, point.gained.y, point.gained.z}},
                        hessian, sweep.passing(r), out);
  };
  if (!sweep.goes_on_at(row)) {
    // The row above belongs to another worker: what its springs pull this row by is computed again.
    sweep.start(std::max(row - 1, 0));
    if (row > 0) linearise(row - 1, sweep.spring_scratch(), sweep.scratch());
  }
  linearise(row, rows_of(near_, row), force.row(row));
  linearise_far_row(point, row);
}

double SpringHessian::far_energy_row(const PaddedVectors& position, int row) const {
  double energy = 0;
  for (int d = near_directions; d < directions_; ++d)
    energy += kernels_->far_energy(cloth_.size, far_at(d, position, row));
  return energy;
}

double SpringHessian::energy_row(const PaddedVectors& position, int row) const {
  NearSprings springs{};
  springs.constants = rows_of(constants_, row);
  springs.position = {position.row(row), position.row(row + 1)};
  const auto limit = static_cast<float>(cloth_.material.strain_limit);
  springs.limit = 1 + limit;
  springs.limit_factor = limit > 0 ? strain_limit_factor : 0.0F;
  return kernels_->near_energy(whole_vectors(cloth_.size), springs) + far_energy_row(position, row);
}

double SpringHessian::damped_energy_row(const PaddedState& state, int row) const {
  NearSprings springs = near_at(state, row);
  springs.step = static_cast<float>(time_step_);
  double energy = kernels_->near_energy(whole_vectors(cloth_.size), springs);
  for (int d = near_directions; d < directions_; ++d) {
    LinearisedSprings far = far_at(d, state.position, row);
    const SpringPlane& plane = cloth_.springs[d];
    far.speed_here = state.velocity.row(row);
    far.speed_there = shifted(state.velocity.row(row + plane.down), plane.right);
    far.step = static_cast<float>(time_step_);
    energy += kernels_->far_energy(cloth_.size, far);
  }
  return energy;
}

std::array<PlaneView, spring_entries> SpringHessian::views(int direction) const {
  std::array<PlaneView, spring_entries> views{};
  for (int k = 0; k < spring_entries; ++k) views[k] = near_.view(direction * spring_entries + k);
  return views;
}

/// Calls visit(col, springs, col of spring, other row, other col) for the second-neighbour springs
/// of the particles of a row.
template <class Visit>
void SpringHessian::for_far_springs(int row, const Visit& visit) const {
  const int n = cloth_.size;
  for (int d = near_directions; d < directions_; ++d)
    for (const int way : {1, -1}) {
      const int down = way * spring_offsets[d].down, right = way * spring_offsets[d].right;
      if (row + down < 0 || row + down >= n) continue;
      const int from = way > 0 ? row : row + down;
      const Direction& planes = far_[d - near_directions];
      const ConstSpringHessianRow springs{planes.t.row(from), planes.x.row(from),
                                          planes.y.row(from), planes.z.row(from),
                                          planes.f.row(from)};
      for (int c = std::max(0, -right); c < n - std::max(0, right); ++c)
        visit(c, springs, way > 0 ? c : c + right, row + down, c + right);
    }
}

void SpringHessian::add_far_forces(const PaddedVectors& at, int row, PaddedVectors& force) const {
  for_far_springs(row, [&](int c, const ConstSpringHessianRow& springs, int s, int r2, int c2) {
    force.x(row, c) += springs.f[s] * (at.x(r2, c2) - at.x(row, c));
    force.y(row, c) += springs.f[s] * (at.y(r2, c2) - at.y(row, c));
    force.z(row, c) += springs.f[s] * (at.z(r2, c2) - at.z(row, c));
  });
}

void SpringHessian::line_diagonals_row(int row, const float* extra,
                                       const LineDiagonals& out) const {
  kernels_->line_diagonals(whole_vectors(cloth_.size), rows_of(near_, row), rows_of(near_, row - 1),
                           inertia_.row(row), extra, out);
}

void SpringHessian::apply_row(const PaddedVectors& x, int row, RowSweep& sweep,
                              const PaddedVectors* rhs, PaddedVectors& out) const {
  const int n = whole_vectors(cloth_.size);
  sweep.multiply(row, rhs, out.row(row), [&](int r, ConstRow3 from, Row3 to) {
    kernels_->apply_springs(n, rows_of(near_, r), inertia_.row(r),
                            {x.row(r), x.row(r + 1), sweep.passing(r), from}, to);
  });
  const float sign = rhs != nullptr ? -1.0F : 1.0F;
  for_far_springs(row, [&](int c, const ConstSpringHessianRow& springs, int s, int r2, int c2) {
    const float dx = x.x(row, c) - x.x(r2, c2), dy = x.y(row, c) - x.y(r2, c2),
                dz = x.z(row, c) - x.z(r2, c2);
    const float along = springs.x[s] * dx + springs.y[s] * dy + springs.z[s] * dz;
    out.x(row, c) += sign * (springs.t[s] * dx + along * springs.x[s]);
    out.y(row, c) += sign * (springs.t[s] * dy + along * springs.y[s]);
    out.z(row, c) += sign * (springs.t[s] * dz + along * springs.z[s]);
  });
}

}  // namespace weft
