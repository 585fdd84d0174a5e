#pragma once

#include <string_view>
#include <vector>

#include "weft/mesh.h"

namespace weft {

/// What names of built-in shapes begin with where files may be named.
inline constexpr std::string_view builtin_prefix = "builtin:";
inline bool is_builtin(std::string_view surface) { return surface.starts_with(builtin_prefix); }

/// A built-in shape.
struct ShapeInfo {
  std::string_view name;
  std::string_view description;
};
/// All shapes, in the order of the documentation.
std::vector<ShapeInfo> built_in_shapes();

/// The shape as a mesh. Deterministic. @throws UsageError naming the nearest known name
TriangleMesh make_shape(std::string_view name);

/// True for the shapes that are images by nature (sheet, disk, torus, cylinder): the image module
/// samples them directly, no map is computed.
bool is_image_by_nature(std::string_view name);

}  // namespace weft
