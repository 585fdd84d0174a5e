#include "weft/cloth/newton/spring_hessian.h"

#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

RowTriple rows_around(const PaddedVectors& field, int r) {
  return {field.row(r - 1), field.row(r), field.row(r + 1)};
}

}  // namespace

SpringHessian::SpringHessian(const Cloth& cloth, const NewtonKernels& kernels)
    : cloth_(cloth),
      kernels_(&kernels),
      inertia_(cloth.size, cloth.size),
      momentum_(cloth.size, cloth.size) {
  const int n = cloth.size;
  for (Direction& one : springs_)
    for (PaddedPlane* plane : {&one.t, &one.x, &one.y, &one.z, &one.f}) *plane = PaddedPlane(n, n);
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
    const std::span<const int> samples = cloth_.mates.mates(i);
    const float share = 1 / static_cast<float>(samples.size());
    for (const int s : samples) {
      momentum_(s / cloth_.size, s % cloth_.size) *= share;
      inertia_(s / cloth_.size, s % cloth_.size) *= share;
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
          1 + limit,
          limited ? strain_limit_factor : 0.0F};
}

void SpringHessian::linearise_row(const PaddedState& state, int row) {
  for (int d = 0; d < directions; ++d) {
    LinearisedSprings springs = springs_at(d, state.position, row);
    const SpringPlane& plane = cloth_.springs[d];
    springs.speed_here = state.velocity.row(row);
    springs.speed_there = shifted(state.velocity.row(row + plane.down), plane.right);
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
  for (int d = 0; d < directions; ++d)
    energy += kernels_->spring_energy(cloth_.size, springs_at(d, position, row));
  return energy;
}

double SpringHessian::damped_energy_row(const PaddedState& state, int row) const {
  double energy = 0;
  for (int d = 0; d < directions; ++d) {
    LinearisedSprings springs = springs_at(d, state.position, row);
    const SpringPlane& plane = cloth_.springs[d];
    springs.speed_here = state.velocity.row(row);
    springs.speed_there = shifted(state.velocity.row(row + plane.down), plane.right);
    springs.step = static_cast<float>(time_step_);
    energy += kernels_->spring_energy(cloth_.size, springs);
  }
  return energy;
}

ConstSpringHessianRow SpringHessian::springs_row(int direction, int row) const {
  const Direction& from = springs_[direction];
  return {from.t.row(row), from.x.row(row), from.y.row(row), from.z.row(row), from.f.row(row)};
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
  for (int d = 0; d < directions; ++d) {
    const auto [down, right] = spring_offsets[d];
    ring.spring[2 * d] = springs_row(d, row);
    ConstSpringHessianRow back = springs_row(d, row - down);
    for (const float** values : {&back.t, &back.x, &back.y, &back.z, &back.f}) *values -= right;
    ring.spring[2 * d + 1] = back;
  }
  return ring;
}

void SpringHessian::gradient_row(const PaddedState& state, const PaddedVectors& wanted, int row,
                                 PaddedVectors& out) const {
  kernels_->gradient(cloth_.size, ring_at(row), rows_around(state.position, row),
                     momentum_.row(row), state.velocity.row(row), wanted.row(row), out.row(row));
}

void SpringHessian::diagonal_row(int row, PaddedBlocks& out) const {
  MutableBlockRow6 blocks{};
  for (int k = 0; k < 6; ++k) blocks.entry[k] = out.entry[k].row(row);
  kernels_->diagonal(cloth_.size, ring_at(row), inertia_.row(row), blocks);
}

void SpringHessian::apply_row(const PaddedVectors& x, int row, PaddedVectors& out) const {
  kernels_->apply_springs(cloth_.size, ring_at(row), rows_around(x, row), inertia_.row(row),
                          out.row(row));
}

}  // namespace weft
