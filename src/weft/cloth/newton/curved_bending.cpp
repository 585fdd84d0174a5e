#include "weft/cloth/newton/curved_bending.h"

#include <algorithm>

#include "weft/cloth/neighbours.h"

namespace weft {

CurvedBending::CurvedBending(const Cloth& cloth, InstructionSet instructions)
    : cloth_(cloth),
      active_(cloth.bending.active && cloth.bending.curved),
      pass_(cloth, instructions) {
  if (!active_) return;
  direction_ = Planes3(cloth.size);
  force_ = Planes3(cloth.size);
}

void CurvedBending::set_position(const Planes3& position, Worker& worker) {
  pass_.curve(position, worker);
}

void CurvedBending::change(const PaddedVectors& direction, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    const ConstRow3 from = direction.row(r);
    const Row3 to = row_of(direction_, r);
    std::copy_n(from.x, cloth_.size, to.x);
    std::copy_n(from.y, cloth_.size, to.y);
    std::copy_n(from.z, cloth_.size, to.z);
  }
  worker.barrier();
  pass_.curve_change(direction_, worker);
}

void CurvedBending::add_row(int row, PaddedVectors& out) {
  const Row3 force = row_of(force_, row), sum = out.row(row);
  std::fill_n(force.x, cloth_.size, 0.0F);
  std::fill_n(force.y, cloth_.size, 0.0F);
  std::fill_n(force.z, cloth_.size, 0.0F);
  pass_.add_row(-1, row, force_);
  for (int c = 0; c < cloth_.size; ++c) {
    sum.x[c] += force.x[c];
    sum.y[c] += force.y[c];
    sum.z[c] += force.z[c];
  }
}

}  // namespace weft
