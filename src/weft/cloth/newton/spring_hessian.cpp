#include "weft/cloth/newton/spring_hessian.h"

#include <algorithm>
#include <utility>

#include "weft/cloth/neighbours.h"

namespace weft {
SpringHessian::SpringHessian(const Cloth& cloth, const NewtonKernels& kernels)
    : cloth_(cloth),
      kernels_(&kernels),
      directions_(cloth.material.bend_springs > 0 ? spring_directions : near_directions),
      inertia_(cloth.size, cloth.size),
      momentum_(cloth.size, cloth.size) {
  const int n = cloth.size;
  for (int d = 0; d < directions_; ++d) {
    Direction& one = springs_[d];
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

LinearisedSprings SpringHessian::springs_at(int direction, const PaddedVectors& position,
                                            int row) const {
  const SpringPlane& springs = cloth_.springs[direction];
  const auto limit = static_cast<float>(cloth_.material.strain_limit);
  const bool limited = limit > 0 && direction <= stretch_v;
  return {springs.rest_length.row(row),
          springs.stiffness.row(row),
          springs.damping.row(row),
          position.row(row),
          shifted(position.row(row + springs.down), springs.right),
          position.row(row),
          position.row(row),
          {},
          {},
          static_cast<float>(1 / time_step_),
          0,
          0,
          1 + limit,
          limited ? strain_limit_factor : 0.0F};
}

void SpringHessian::linearise_row(const PaddedState& state, float guessed_share, int row) {
  for (int d = 0; d < directions_; ++d) {
    LinearisedSprings springs = springs_at(d, state.position, row);
    const SpringPlane& plane = cloth_.springs[d];
    springs.speed_here = state.velocity.row(row);
    springs.speed_there = shifted(state.velocity.row(row + plane.down), plane.right);
    springs.guessed_share = guessed_share;
    springs.start_here = state.start.row(row);
    springs.start_there = shifted(state.start.row(row + plane.down), plane.right);
    Direction& out = springs_[d];
    kernels_->linearise(
        cloth_.size, springs,
        {out.t.row(row), out.x.row(row), out.y.row(row), out.z.row(row), out.f.row(row)});
  }
}

double SpringHessian::energy_row(const PaddedVectors& position, int row) const {
  double energy = 0;
  for (int d = 0; d < directions_; ++d)
    energy += kernels_->spring_energy(cloth_.size, springs_at(d, position, row));
  return energy;
}

double SpringHessian::damped_energy_row(const PaddedState& state, int row) const {
  double energy = 0;
  for (int d = 0; d < directions_; ++d) {
    LinearisedSprings springs = springs_at(d, state.position, row);
    const SpringPlane& plane = cloth_.springs[d];
    springs.speed_here = state.velocity.row(row);
    springs.speed_there = shifted(state.velocity.row(row + plane.down), plane.right);
    springs.step = static_cast<float>(time_step_);
    energy += kernels_->spring_energy(cloth_.size, springs);
  }
  return energy;
}

ConstSpringHessianRow SpringHessian::springs_row(int direction, int row, int first_col) const {
  const Direction& from = springs_[direction];
  return {from.t.row(row) + first_col, from.x.row(row) + first_col, from.y.row(row) + first_col,
          from.z.row(row) + first_col, from.f.row(row) + first_col};
}

std::array<PaddedPlane*, 4> SpringHessian::planes(int direction) {
  Direction& from = springs_[direction];
  return {&from.t, &from.x, &from.y, &from.z};
}

std::array<PlaneView, 4> SpringHessian::views(int direction) const {
  const Direction& from = springs_[direction];
  const auto view = [](const PaddedPlane& plane) {
    return PlaneView{plane.row(0), plane.stride()};
  };
  return {view(from.t), view(from.x), view(from.y), view(from.z)};
}

SpringRing SpringHessian::ring_at(int row) const {
  SpringRing ring{};
  for (int d = 0; d < near_directions; ++d) {
    const auto [down, right] = spring_offsets[d];
    ring.spring[2 * d] = springs_row(d, row);
    ConstSpringHessianRow back = springs_row(d, row - down);
    for (const float** values : {&back.t, &back.x, &back.y, &back.z, &back.f}) *values -= right;
    ring.spring[2 * d + 1] = back;
  }
  return ring;
}

/// Calls visit(col, spring, col of spring, other row, other col) for the second-neighbour springs
/// of the particles of a row.
template <class Visit>
void SpringHessian::for_far_springs(int row, const Visit& visit) const {
  const int n = cloth_.size;
  for (int d = near_directions; d < directions_; ++d)
    for (const int way : {1, -1}) {
      const int down = way * spring_offsets[d].down, right = way * spring_offsets[d].right;
      if (row + down < 0 || row + down >= n) continue;
      const ConstSpringHessianRow springs = springs_row(d, way > 0 ? row : row + down);
      for (int c = std::max(0, -right); c < n - std::max(0, right); ++c)
        visit(c, springs, way > 0 ? c : c + right, row + down, c + right);
    }
}

void SpringHessian::gradient_row(const PaddedState& state, const PaddedVectors& wanted, int row,
                                 PaddedVectors& out) const {
  kernels_->gradient(whole_vectors(cloth_.size), ring_at(row), rows_around(state.position, row),
                     momentum_.row(row), state.velocity.row(row), wanted.row(row), out.row(row));
  const PaddedVectors& at = state.position;
  for_far_springs(row, [&](int c, const ConstSpringHessianRow& springs, int s, int r2, int c2) {
    out.x(row, c) -= springs.f[s] * (at.x(r2, c2) - at.x(row, c));
    out.y(row, c) -= springs.f[s] * (at.y(r2, c2) - at.y(row, c));
    out.z(row, c) -= springs.f[s] * (at.z(r2, c2) - at.z(row, c));
  });
}

void SpringHessian::diagonal_row(int row, PaddedBlocks& out) const {
  MutableBlockRow6 blocks{};
  for (int k = 0; k < 6; ++k) blocks.entry[k] = out.entry[k].row(row);
  kernels_->diagonal(whole_vectors(cloth_.size), ring_at(row), inertia_.row(row), blocks);
}

void SpringHessian::line_diagonals_row(int row, const float* extra,
                                       const LineDiagonals& out) const {
  kernels_->line_diagonals(whole_vectors(cloth_.size), ring_at(row), inertia_.row(row), extra, out);
}

void SpringHessian::sweep_row(const Sweep& sweep, int row, Row3 out) const {
  ConstSpringHessianRow springs[near_directions];
  for (int d = 0; d < near_directions; ++d) springs[d] = springs_row(d, row);
  PaddedVectors& scratch = sweep.scratch;
  const int even = row & 1;
  kernels_->apply_springs(
      whole_vectors(cloth_.size), springs,
      {sweep.x.row(row), sweep.x.row(row + 1), inertia_.row(row), std::as_const(scratch).row(even),
       scratch.row(1 - even), scratch.row(2), scratch.row(3), scratch.row(4)},
      out);
}

void SpringHessian::apply_row(Sweep& sweep, int row, PaddedVectors& out) const {
  if (!sweep.started) {
    // The row above belongs to another worker: the forces of its springs on this row are computed
    // again.
    for (const int carry : {0, 1}) clear_row(sweep.scratch.row(carry), cloth_.size);
    if (row > 0) sweep_row(sweep, row - 1, sweep.scratch.row(5));
    sweep.started = true;
  }
  sweep_row(sweep, row, out.row(row));
  const PaddedVectors& x = sweep.x;
  for_far_springs(row, [&](int c, const ConstSpringHessianRow& springs, int s, int r2, int c2) {
    const float dx = x.x(row, c) - x.x(r2, c2), dy = x.y(row, c) - x.y(r2, c2),
                dz = x.z(row, c) - x.z(r2, c2);
    const float along = springs.x[s] * dx + springs.y[s] * dy + springs.z[s] * dz;
    out.x(row, c) += springs.t[s] * dx + along * springs.x[s];
    out.y(row, c) += springs.t[s] * dy + along * springs.y[s];
    out.z(row, c) += springs.t[s] * dz + along * springs.z[s];
  });
}

}  // namespace weft
