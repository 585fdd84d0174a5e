#include "weft/cloth/strain_stiffening.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// The stretch springs that start from a row and are longer than the limit: visit(sample, sample,
/// additional stiffness, length beyond the limit, direction).
template <class Visit>
void each_beyond(const Cloth& cloth, const Planes3& positions, int row, const Visit& visit) {
  const double longest = 1 + cloth.material.strain_limit;
  for (const int d : {stretch_u, stretch_v}) {
    const SpringPlane& springs = cloth.springs[d];
    if (row + springs.down >= cloth.size) continue;
    for (int c = 0; c + springs.right < cloth.size; ++c) {
      const int here = row * cloth.size + c;
      const int there = here + springs.down * cloth.size + springs.right;
      const Vec3d along =
          vec_cast<double>(positions.at(there)) - vec_cast<double>(positions.at(here));
      const double l = length(along), over = l - longest * springs.rest_length(row, c);
      const double stiffness = double{strain_limit_factor} * springs.stiffness(row, c);
      if (over > 0 && stiffness > 0) visit(here, there, stiffness, over, (1 / l) * along);
    }
  }
}

}  // namespace

double strain_limit_energy(const Cloth& cloth, const Planes3& positions, int row) {
  double energy = 0;
  if (cloth.material.strain_limit > 0)
    each_beyond(cloth, positions, row, [&](int, int, double stiffness, double over, Vec3d) {
      energy += 0.5 * stiffness * over * over;
    });
  return energy;
}

void add_strain_limit_forces(const Cloth& cloth, const Planes3& positions, Planes3& forces) {
  if (!(cloth.material.strain_limit > 0)) return;
  for (int row = 0; row < cloth.size; ++row)
    each_beyond(cloth, positions, row,
                [&](int here, int there, double stiffness, double over, Vec3d along) {
                  const Vec3f pull = vec_cast<float>(stiffness * over * along);
                  forces.set(here, forces.at(here) + pull);
                  forces.set(there, forces.at(there) - pull);
                });
}

}  // namespace weft
