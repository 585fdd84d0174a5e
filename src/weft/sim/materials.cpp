#include <array>

#include "weft/fabric.h"

namespace weft {
namespace {

// What is measured and what is an estimate of the class: docs/materials.md.
constexpr std::array<NamedMaterial, 9> materials{{
    {"cotton",
     {.density = 0.15,
      .stretch = {20000, 10000},
      .shear = 100,
      .bending = {1.1e-05, 6.3e-06},
      .damping = 2,
      .thickness = 0.002}},
    {"silk",
     {.density = 0.07,
      .stretch = {15000, 8000},
      .shear = 40,
      .bending = {3e-06, 2.1e-06},
      .damping = 1,
      .thickness = 0.002}},
    {"wool",
     {.density = 0.27,
      .stretch = {10000, 6000},
      .shear = 90,
      .bending = {1.4e-05, 1e-05},
      .damping = 3,
      .thickness = 0.0025}},
    {"denim",
     {.density = 0.41,
      .stretch = {40000, 20000},
      .shear = 250,
      .bending = {8e-05, 4.5e-05},
      .damping = 3,
      .thickness = 0.0025}},
    {"leather",
     {.density = 0.6,
      .stretch = 10000,
      .shear = 2000,
      .bending = 2.1e-05,
      .damping = 4,
      .thickness = 0.003}},
    {"linen",
     {.density = 0.18,
      .stretch = {30000, 15000},
      .shear = 120,
      .bending = {2.4e-05, 1.7e-05},
      .damping = 2,
      .thickness = 0.002}},
    {"jersey",
     {.density = 0.187,
      .stretch = {1200, 600},
      .shear = 80,
      .bending = {7e-06, 5e-06},
      .damping = 3,
      .thickness = 0.002}},
    {"chiffon",
     {.density = 0.04,
      .stretch = {10000, 5000},
      .shear = 20,
      .bending = {9e-07, 7e-07},
      .damping = 1,
      .thickness = 0.002}},
    {"canvas",
     {.density = 0.5,
      .stretch = {50000, 25000},
      .shear = 300,
      .bending = {0.00018, 0.000125},
      .damping = 3,
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
