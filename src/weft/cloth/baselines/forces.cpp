#include "weft/cloth/baselines/forces.h"

#include <algorithm>

#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

void clear_row(Planes3& planes, int row) {
  const Row3 out = row_of(planes, row);
  for (float* values : {out.x, out.y, out.z}) std::fill(values, values + planes.size(), 0.0F);
}

/// Without velocities.
NeighbourSprings springs_of(const Cloth& cloth, const NeighbourRow& to, int row,
                            const Planes3& position) {
  const SpringPlane& springs = cloth.springs[to.direction];
  const int at = to.spring_row, shift = to.spring_shift;
  return {to.first,
          to.last,
          springs.rest_length.row(at) + shift,
          springs.stiffness.row(at) + shift,
          springs.damping.row(at) + shift,
          row_of(position, row),
          shifted(row_of(position, to.other_row), to.shift),
          {},
          {}};
}

}  // namespace

SpringForces::SpringForces(const Cloth& cloth, InstructionSet instructions)
    : cloth_(cloth), kernels_(implicit_kernels_for(instructions)) {}

void SpringForces::gather_elastic(int row, const Planes3& position, Planes3& force) const {
  clear_row(force, row);
  for (const NeighbourRow& to : NeighbourRows(cloth_.size, row, used_directions(cloth_)))
    kernels_.elastic(springs_of(cloth_, to, row, position), row_of(force, row));
}

void SpringForces::gather_damped(int row, const ClothState& state, Planes3& force) const {
  gather_elastic(row, state.position, force);
  if (cloth_.material.damping == 0) return;
  for (const NeighbourRow& to : NeighbourRows(cloth_.size, row, used_directions(cloth_))) {
    NeighbourSprings springs = springs_of(cloth_, to, row, state.position);
    springs.velocity = row_of(state.velocity, row);
    springs.other_velocity = shifted(row_of(state.velocity, to.other_row), to.shift);
    kernels_.axial_damping(springs, row_of(force, row));
  }
}

}  // namespace weft
