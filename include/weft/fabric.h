#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/integrators.h"
#include "weft/material.h"
#include "weft/progress.h"
#include "weft/threads.h"

namespace weft {

/// Cusick's drape test: a disc of cloth 30 cm across lies on a support 18 cm across, and its shadow
/// from above is measured.
struct DrapeTestOptions {
  int size = 65;   ///< samples a side of the disc's image
  int starts = 5;  ///< runs, each with another push, as the number of folds varies
  std::uint64_t seed = 1;
  IntegratorOptions integrator;
  double time_step = 1.0 / 240;  ///< [s]
  double seconds = 20;           ///< at most, on each grid of a run; ends when the disc rests
  TeamOptions team = 1;
  Progress* progress = nullptr;
};

/// The result of one run of the drape test.
struct DrapedDisc {
  /// (S - S_support) / (S_disc - S_support), S the area of the shadow: 0 hangs straight down, 1
  /// stays flat.
  double coefficient = 0;
  int folds = 0;
  double kinetic_energy = 0;  ///< at the end [J]
};

struct DrapeResult {
  double coefficient = 0;              ///< mean over the starts
  double spread = 0;                   ///< standard deviation between them
  double kinetic_energy = 0;           ///< the largest [J]
  std::vector<DrapedDisc> discs;       ///< one a start
  [[nodiscard]] double folds() const;  ///< mean
};

/// Simulates the drape test of a material. The disc's innermost rings are pinned, so that bending
/// begins at the support's edge. The disc starts level, its weight is applied gradually within a
/// second, and initial velocities of up to 5 cm/s form a few random waves around it. Air drag slows
/// the disc until it rests, and it must remain at rest without air. There is no collision.
/// @throws SceneError for a material or a size that no cloth can have
DrapeResult measure_drape(const Material& material, const DrapeTestOptions& options);

/// A bending stiffness and how a disc of it drapes.
struct FittedBending {
  double bending = 0;  ///< B, alike along warp and weft [N m]
  DrapeResult drape;
};

/// Finds the bending stiffness of a measured drape coefficient by bisection of its logarithm, all
/// other values of the material as given.
/// @param coefficient  in (0, 1)
/// @throws InputError where no bending stiffness of cloth drapes so
FittedBending fit_bending(Material material, double coefficient, const DrapeTestOptions& options);

/// B = density g c^3 of a bending length c [m] [astmd1388]; and back.
double bending_of_length(double density, double length);
double length_of_bending(double density, double bending);

/// A fabric that scenes call by name.
struct NamedMaterial {
  std::string_view name;
  Material material;
};

/// All named fabrics, in the order of the documentation.
std::span<const NamedMaterial> named_materials();

std::optional<Material> find_material(std::string_view name);

}  // namespace weft
