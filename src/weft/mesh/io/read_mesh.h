#pragma once

#include <filesystem>
#include <string_view>

#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// Reads OBJ, OFF, PLY or STL by the ending of the name; polygons are split into fans of triangles;
/// STL vertices at equal positions are joined.
/// @throws InputError with FILE:LINE where the format has lines, for what is missing, cut short,
///         malformed, not finite or above 1e30, or an index out of range
TriangleMesh read_mesh(const std::filesystem::path& path);

/// The same from memory; `name` is what errors call it.
TriangleMesh parse_obj(std::string_view bytes, std::string_view name);
TriangleMesh parse_off(std::string_view bytes, std::string_view name);
TriangleMesh parse_ply(std::string_view bytes, std::string_view name);
TriangleMesh parse_stl(std::string_view bytes, std::string_view name);

}  // namespace weft
