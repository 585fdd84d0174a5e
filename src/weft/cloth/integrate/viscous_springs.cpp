#include "weft/cloth/integrate/viscous_springs.h"

#include <algorithm>
#include <cmath>

#include "weft/cloth/forces.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// What one neighbour's springs are made of.
struct SpringRow {
  const float *rest, *stiffness, *viscosity;  ///< at the column of this end
};

void add_neighbour(const NeighbourRow& to, const SpringRow& spring, const ClothState& state,
                   int row, Row3 force) {
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
    const float length = std::sqrt(squared > least_squared_length ? squared : least_squared_length);
    const float pull = spring.stiffness[c] * ((length - spring.rest[c]) / length);
    const float lag = spring.viscosity[c];
    force.x[c] += pull * dx + lag * (other.x[c + shift] - speed.x[c]);
    force.y[c] += pull * dy + lag * (other.y[c + shift] - speed.y[c]);
    force.z[c] += pull * dz + lag * (other.z[c + shift] - speed.z[c]);
  }
}

}  // namespace

void gather_viscous(const Cloth& cloth, const ViscousSprings& springs, int row,
                    const ClothState& state, Planes3& force) {
  const Row3 out = row_of(force, row);
  for (float* plane : {out.x, out.y, out.z}) std::fill(plane, plane + cloth.size, 0.0F);
  for (const NeighbourRow& to : NeighbourRows(cloth.size, row)) {
    const int d = to.direction, at = to.spring_row, shift = to.spring_shift;
    add_neighbour(to,
                  {cloth.springs[d].rest_length.row(at) + shift,
                   springs.stiffness[d].row(at) + shift, springs.viscosity[d].row(at) + shift},
                  state, row, out);
  }
}

}  // namespace weft
