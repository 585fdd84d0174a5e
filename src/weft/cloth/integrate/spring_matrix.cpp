#include "weft/cloth/integrate/spring_matrix.h"

#include <algorithm>
#include <cmath>

#include "weft/cloth/forces.h"
#include "weft/cloth/neighbours.h"

namespace weft {

SpringMatrix::SpringMatrix(int size) : size_(size) {
  for (Direction& direction : directions_) direction = {Grid<float>(size, size), Planes3(size)};
}

void SpringMatrix::linearise_row(const Cloth& cloth, const Planes3& position, double time_step,
                                 int row) {
  const auto h = static_cast<float>(time_step);
  for (int index = 0; index < spring_directions; ++index) {
    const SpringPlane& springs = cloth.springs[index];
    if (row + springs.down >= size_) continue;
    const ConstRow3 here = row_of(position, row), there = row_of(position, row + springs.down);
    const float *stiffness = springs.stiffness.row(row), *rest = springs.rest_length.row(row);
    const float* damping = springs.damping.row(row);
    float* transverse = directions_[index].transverse.row(row);
    const Row3 axial = row_of(directions_[index].axial, row);
    const int shift = springs.right;
    const int first = std::max(0, -shift), last = size_ - std::max(0, shift);
#pragma omp simd
    for (int c = first; c < last; ++c) {
      const float dx = there.x[c + shift] - here.x[c];
      const float dy = there.y[c + shift] - here.y[c];
      const float dz = there.z[c + shift] - here.z[c];
      const float squared = dx * dx + dy * dy + dz * dz;
      const float safe = squared > least_squared_length ? squared : least_squared_length;
      const float length = std::sqrt(safe);
      const float strain = 1 - rest[c] / length;
      const float whole = h * (h * stiffness[c] + damping[c]);
      const float across = strain > 0 ? h * h * stiffness[c] * strain : 0.0F;
      const float along = std::sqrt(whole - across) / length;
      transverse[c] = across;
      axial.x[c] = along * dx;
      axial.y[c] = along * dy;
      axial.z[c] = along * dz;
    }
  }
}

void SpringMatrix::multiply_row(const Planes3& in, Planes3& out, int row) const {
  const Row3 sum = row_of(out, row);
  std::fill(sum.x, sum.x + size_, 0.0F);
  std::fill(sum.y, sum.y + size_, 0.0F);
  std::fill(sum.z, sum.z + size_, 0.0F);
  const ConstRow3 here = row_of(in, row);
  for (const NeighbourRow& to : NeighbourRows(size_, row)) {
    const ConstRow3 there = row_of(in, to.other_row);
    const float* a = directions_[to.direction].transverse.row(to.spring_row);
    const ConstRow3 s = row_of(directions_[to.direction].axial, to.spring_row);
    const int shift = to.shift, spring = to.spring_shift;
#pragma omp simd
    for (int c = to.first; c < to.last; ++c) {
      const float dx = here.x[c] - there.x[c + shift];
      const float dy = here.y[c] - there.y[c + shift];
      const float dz = here.z[c] - there.z[c + shift];
      const float sx = s.x[c + spring], sy = s.y[c + spring], sz = s.z[c + spring];
      const float along = sx * dx + sy * dy + sz * dz;
      sum.x[c] += a[c + spring] * dx + along * sx;
      sum.y[c] += a[c + spring] * dy + along * sy;
      sum.z[c] += a[c + spring] * dz + along * sz;
    }
  }
}

void SpringMatrix::add_diagonal_row(Blocks& blocks, int row) const {
  std::array<float*, 6> out{};
  for (int i = 0; i < 6; ++i) out[i] = blocks[i].row(row);
  for (const NeighbourRow& to : NeighbourRows(size_, row)) {
    const float* a = directions_[to.direction].transverse.row(to.spring_row);
    const ConstRow3 s = row_of(directions_[to.direction].axial, to.spring_row);
    const int spring = to.spring_shift;
    for (int c = to.first; c < to.last; ++c) {
      const float sx = s.x[c + spring], sy = s.y[c + spring], sz = s.z[c + spring];
      out[0][c] += a[c + spring] + sx * sx;
      out[1][c] += sx * sy;
      out[2][c] += sx * sz;
      out[3][c] += a[c + spring] + sy * sy;
      out[4][c] += sy * sz;
      out[5][c] += a[c + spring] + sz * sz;
    }
  }
}

}  // namespace weft
