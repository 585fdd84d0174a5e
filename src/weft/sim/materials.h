#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "weft/cloth/material.h"

namespace weft {

/// A fabric that scenes call by name.
struct NamedMaterial {
  std::string_view name;
  Material material;
};

/// All of them, in the order of the documentation.
std::span<const NamedMaterial> named_materials();

std::optional<Material> find_material(std::string_view name);

}  // namespace weft
