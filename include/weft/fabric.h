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
  int starts = 5;  ///< runs, each from another push: folds come in several numbers
  std::uint64_t seed = 1;
  IntegratorOptions integrator;
  double time_step = 1.0 / 240;  ///< [s]
  double seconds = 20;           ///< of a run, at most: one ends where the disc is at rest
  TeamOptions team = 1;
  Progress* progress = nullptr;
};

/// How one disc came to rest.
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

/// The disc's innermost rings are pinned, up to the one from which on bending starts nearest to the
/// support's edge; the rest is let down from level within a second, pushed by up to 5 cm/s in a few
/// random waves around it. Air slows it until it rests, which it has to do without air as well.
/// Nothing else touches it.
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

/// All of them, in the order of the documentation.
std::span<const NamedMaterial> named_materials();

std::optional<Material> find_material(std::string_view name);

}  // namespace weft
