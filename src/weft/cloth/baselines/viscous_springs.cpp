#include "weft/cloth/baselines/viscous_springs.h"

#include <algorithm>

#include "weft/cloth/neighbours.h"

namespace weft {

ViscousSprings::ViscousSprings(const Cloth& cloth, const ThreadTeam& team)
    : cloth_(cloth), kernels_(filtering_kernels_for(team.instructions())) {
  for (int d = 0; d < spring_directions; ++d)
    stiffness[d] = viscosity[d] = Grid<float>(cloth.size, cloth.size);
}

void ViscousSprings::gather_row(int row, const ClothState& state, Planes3& force) const {
  const Row3 out = row_of(force, row);
  for (float* plane : {out.x, out.y, out.z}) std::fill(plane, plane + cloth_.size, 0.0F);
  const ConstRow3 x = row_of(state.position, row), v = row_of(state.velocity, row);
  for (const NeighbourRow& to : NeighbourRows(cloth_.size, row)) {
    const int d = to.direction, at = to.spring_row, shift = to.spring_shift;
    kernels_.viscous_springs(
        {cloth_.springs[d].rest_length.row(at) + shift, stiffness[d].row(at) + shift,
         viscosity[d].row(at) + shift, x, v,
         shifted(row_of(state.position, to.other_row), to.shift),
         shifted(row_of(state.velocity, to.other_row), to.shift), to.first, to.last},
        out);
  }
}

}  // namespace weft
