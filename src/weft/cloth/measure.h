#pragma once

#include <optional>
#include <string>

#include "weft/cloth/cloth.h"

namespace weft {

/// |l / r - 1| over the stretch springs (a seam spring once).
struct StrainSummary {
  double mean = 0, p99 = 0, max = 0;
};
StrainSummary measure_strain(const Cloth& cloth, const ClothState& state);

/// Particles counted once, weighted by mass [m].
Vec3d centre_of_mass(const Cloth& cloth, const ClothState& state);
/// [J]; potential: springs, bending and gravity (zero at the origin).
double kinetic_energy(const Cloth& cloth, const ClothState& state);
double potential_energy(const Cloth& cloth, const ClothState& state, Vec3d gravity);

/// The first particle whose position or velocity is not finite, as (row, col).
struct BadParticle {
  int row = 0, col = 0;
};
std::optional<BadParticle> find_not_finite(const ClothState& state);

}  // namespace weft
