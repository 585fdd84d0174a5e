#pragma once

#include <optional>
#include <span>
#include <string>

#include "weft/cloth/cloth.h"

namespace weft {

StrainSummary measure_strain(const Cloth& cloth, const ClothState& state);
/// The mean of l / r - 1 over the springs around each sample. @param springs  those of stretch
/// @param strains  [n x n]
void strain_at_samples(std::span<const SpringPlane> springs, const Planes3& positions,
                       Grid<float>& strains);

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
