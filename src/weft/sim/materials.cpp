#include "weft/sim/materials.h"

#include <array>

namespace weft {
namespace {

// Area densities are those that fabrics of the kind are sold at: shirting cotton 120 to 170 g/m^2;
// silk by the momme (4.34 g/m^2), 16 momme for blouses; wool suiting 240 to 300 g/m^2; denim by the
// ounce a square yard (33.9 g/m^2), 12 ounces for trousers; garment leather of 1 mm at about 0.75
// g/cm^3. Membrane stiffnesses keep the fabrics' order, far below their true tens of kN/m, which no
// eye tells from these; the strain limit does the rest.
constexpr std::array<NamedMaterial, 5> materials{{
    {"cotton",
     {.density = 0.15,
      .stretch = 2000,
      .shear = 400,
      .bend_springs = 0.5,
      .damping = 2,
      .strain_limit = 0.05,
      .thickness = 0.002}},
    {"silk",
     {.density = 0.07,
      .stretch = 1500,
      .shear = 150,
      .bend_springs = 0.05,
      .damping = 1,
      .strain_limit = 0.05,
      .thickness = 0.002}},
    {"wool",
     {.density = 0.27,
      .stretch = 1500,
      .shear = 300,
      .bend_springs = 0.8,
      .damping = 3,
      .strain_limit = 0.08,
      .thickness = 0.0025}},
    {"denim",
     {.density = 0.41,
      .stretch = 4000,
      .shear = 1200,
      .bend_springs = 3,
      .damping = 3,
      .strain_limit = 0.03,
      .thickness = 0.0025}},
    {"leather",
     {.density = 0.75,
      .stretch = 5000,
      .shear = 2500,
      .bend_springs = 6,
      .damping = 4,
      .strain_limit = 0.05,
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
