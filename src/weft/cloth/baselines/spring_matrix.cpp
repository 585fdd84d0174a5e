#include "weft/cloth/baselines/spring_matrix.h"

#include <algorithm>

#include "weft/cloth/neighbours.h"

namespace weft {

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

/// Without what they multiply.
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
