#include "weft/cloth/baselines/spring_matrix.h"

#include <algorithm>

#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// The springs between a row and one of its neighbour rows, without velocities.
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
  clear(row_of(force, row), force.size());
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

SpringMatrix::SpringMatrix(const Cloth& cloth, InstructionSet instructions)
    : cloth_(cloth), kernels_(implicit_kernels_for(instructions)) {
  const int n = cloth.size;
  for (int d = 0; d < used_directions(cloth); ++d) directions_[d] = {Grid<float>(n, n), Planes3(n)};
}

void SpringMatrix::linearise_row(const Planes3& position, double time_step, int row) {
  const int n = cloth_.size;
  for (int index = 0; index < used_directions(cloth_); ++index) {
    const SpringPlane& springs = cloth_.springs[index];
    if (row + springs.down >= n) continue;
    const int shift = springs.right;
    kernels_.linearise({std::max(0, -shift),
                        n - std::max(0, shift),
                        springs.rest_length.row(row),
                        springs.stiffness.row(row),
                        springs.damping.row(row),
                        row_of(position, row),
                        shifted(row_of(position, row + springs.down), shift),
                        {},
                        {}},
                       static_cast<float>(time_step), directions_[index].transverse.row(row),
                       row_of(directions_[index].axial, row));
  }
}

/// The blocks of a neighbour row, without the vectors they multiply.
NeighbourBlocks SpringMatrix::blocks_of(const NeighbourRow& to) const {
  const Direction& direction = directions_[to.direction];
  return {to.first,
          to.last,
          direction.transverse.row(to.spring_row) + to.spring_shift,
          shifted(row_of(direction.axial, to.spring_row), to.spring_shift),
          {},
          {}};
}

void SpringMatrix::multiply_row(const Planes3& in, Planes3& out, int row) const {
  const Row3 sum = row_of(out, row);
  for (float* values : {sum.x, sum.y, sum.z}) std::fill(values, values + cloth_.size, 0.0F);
  for (const NeighbourRow& to : NeighbourRows(cloth_.size, row, used_directions(cloth_))) {
    NeighbourBlocks blocks = blocks_of(to);
    blocks.value = row_of(in, row);
    blocks.other_value = shifted(row_of(in, to.other_row), to.shift);
    kernels_.multiply(blocks, sum);
  }
}

void SpringMatrix::add_diagonal_row(Blocks& blocks, int row) const {
  for (const NeighbourRow& to : NeighbourRows(cloth_.size, row, used_directions(cloth_)))
    kernels_.add_blocks(blocks_of(to), row_of(blocks, row));
}

}  // namespace weft
