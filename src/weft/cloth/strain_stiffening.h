#pragma once

#include "weft/cloth/cloth.h"

namespace weft {

/// Additional stiffness of stretch springs beyond the material's strain limit, over their own,
/// where an integrator has the limit in its energy: a spring of length l then holds 10 k max(0, l -
/// (1 + limit) r) more.
inline constexpr float strain_limit_factor = 10;

/// The energy of what springs that start from a row hold beyond the limit. [J]
/// @param positions  [n x n] [m]
double strain_limit_energy(const Cloth& cloth, const Planes3& positions, int row);
/// Adds its forces on all samples, mates not summed. [n x n] [N]
void add_strain_limit_forces(const Cloth& cloth, const Planes3& positions, Planes3& forces);

}  // namespace weft
