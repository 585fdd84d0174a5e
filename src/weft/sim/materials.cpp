#include "weft/sim/materials.h"

#include <array>

namespace weft {
namespace {

// Densities and bending stiffnesses are those of real fabrics, with their sources in
// docs/materials.md. Membrane stiffnesses keep the fabrics' order, far below their true tens of
// kN/m, which no eye tells from these; the strain limit does the rest.
constexpr std::array<NamedMaterial, 9> materials{{
    {"cotton",
     {.density = 0.15,
      .stretch = 2000,
      .shear = 400,
      .bending = 1.2e-5,
      .damping = 2,
      .strain_limit = 0.05,
      .thickness = 0.002}},
    {"silk",
     {.density = 0.07,
      .stretch = 1500,
      .shear = 150,
      .bending = 2.5e-6,
      .damping = 1,
      .strain_limit = 0.05,
      .thickness = 0.002}},
    {"wool",
     {.density = 0.27,
      .stretch = 1500,
      .shear = 300,
      .bending = 1.2e-5,
      .damping = 3,
      .strain_limit = 0.08,
      .thickness = 0.0025}},
    {"denim",
     {.density = 0.41,
      .stretch = 4000,
      .shear = 1200,
      .bending = 6e-5,
      .damping = 3,
      .strain_limit = 0.03,
      .thickness = 0.0025}},
    {"leather",
     {.density = 0.6,
      .stretch = 5000,
      .shear = 2500,
      .bending = 8e-5,
      .damping = 4,
      .strain_limit = 0.05,
      .thickness = 0.003}},
    {"linen",
     {.density = 0.18,
      .stretch = 2500,
      .shear = 400,
      .bending = 2e-5,
      .damping = 2,
      .strain_limit = 0.03,
      .thickness = 0.002}},
    {"jersey",
     {.density = 0.187,
      .stretch = 800,
      .shear = 300,
      .bending = 6e-6,
      .damping = 3,
      .strain_limit = 0.1,
      .thickness = 0.002}},
    {"chiffon",
     {.density = 0.04,
      .stretch = 1200,
      .shear = 100,
      .bending = 8e-7,
      .damping = 1,
      .strain_limit = 0.05,
      .thickness = 0.002}},
    {"canvas",
     {.density = 0.5,
      .stretch = 5000,
      .shear = 2000,
      .bending = 0.00015,
      .damping = 3,
      .strain_limit = 0.03,
      .thickness = 0.003}},
}};

}  // namespace

std::span<const NamedMaterial> named_materials() { return materials; }

std::optional<Material> find_material(std::string_view name) {
  for (const NamedMaterial& named : materials)
    if (named.name == name) return named.material;
  return std::nullopt;
}

}  // namespace weft
