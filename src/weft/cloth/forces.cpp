#include "weft/cloth/forces.h"

#include <algorithm>
#include <cmath>

#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

void clear_row(Planes3& planes, int row) {
  const Row3 out = row_of(planes, row);
  const int n = planes.size();
  std::fill(out.x, out.x + n, 0.0F);
  std::fill(out.y, out.y + n, 0.0F);
  std::fill(out.z, out.z + n, 0.0F);
}

void add_elastic(const NeighbourRow& to, const SpringPlane& springs, ConstRow3 here,
                 ConstRow3 there, Row3 force) {
  const float* stiffness = springs.stiffness.row(to.spring_row);
  const float* rest = springs.rest_length.row(to.spring_row);
  const int shift = to.shift;
  const int spring = to.spring_shift;
#pragma omp simd
  for (int c = to.first; c < to.last; ++c) {
    const float dx = there.x[c + shift] - here.x[c];
    const float dy = there.y[c + shift] - here.y[c];
    const float dz = there.z[c + shift] - here.z[c];
    const float squared = dx * dx + dy * dy + dz * dz;
    const float length = std::sqrt(squared > least_squared_length ? squared : least_squared_length);
    const float pull = stiffness[c + spring] * (length - rest[c + spring]) / length;
    force.x[c] += pull * dx;
    force.y[c] += pull * dy;
    force.z[c] += pull * dz;
  }
}

void add_axial_damping(const NeighbourRow& to, const SpringPlane& springs, const ClothState& state,
                       int row, Row3 force) {
  const float* damping = springs.damping.row(to.spring_row);
  const ConstRow3 here = row_of(state.position, row);
  const ConstRow3 there = row_of(state.position, to.other_row);
  const ConstRow3 speed = row_of(state.velocity, row);
  const ConstRow3 other = row_of(state.velocity, to.other_row);
  const int shift = to.shift;
#pragma omp simd
  for (int c = to.first; c < to.last; ++c) {
    const float dx = there.x[c + shift] - here.x[c];
    const float dy = there.y[c + shift] - here.y[c];
    const float dz = there.z[c + shift] - here.z[c];
    const float squared = dx * dx + dy * dy + dz * dz;
    const float along = dx * (other.x[c + shift] - speed.x[c]) +
                        dy * (other.y[c + shift] - speed.y[c]) +
                        dz * (other.z[c + shift] - speed.z[c]);
    const float pull = damping[c + to.spring_shift] * along /
                       (squared > least_squared_length ? squared : least_squared_length);
    force.x[c] += pull * dx;
    force.y[c] += pull * dy;
    force.z[c] += pull * dz;
  }
}

}  // namespace

void gather_elastic(const Cloth& cloth, int row, const Planes3& position, Planes3& force) {
  clear_row(force, row);
  for (const NeighbourRow& to : NeighbourRows(cloth.size, row))
    add_elastic(to, cloth.springs[to.direction], row_of(position, row),
                row_of(position, to.other_row), row_of(force, row));
}

void gather_damped(const Cloth& cloth, int row, const ClothState& state, Planes3& force) {
  gather_elastic(cloth, row, state.position, force);
  if (cloth.material.damping == 0) return;
  for (const NeighbourRow& to : NeighbourRows(cloth.size, row))
    add_axial_damping(to, cloth.springs[to.direction], state, row, row_of(force, row));
}

}  // namespace weft
