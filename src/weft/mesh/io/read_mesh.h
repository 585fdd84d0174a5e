#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// Reads OBJ, OFF, PLY, STL, GLB or glTF by the ending of the name; polygons are split into fans of
/// triangles; STL and glTF vertices at equal positions are joined.
/// @throws InputError with FILE:LINE where the format has lines, for what is missing, cut short,
///         malformed, not finite or above 1e30, or an index out of range
TriangleMesh read_mesh(const std::filesystem::path& path);

/// The same from memory; `name` is what errors call it.
TriangleMesh parse_obj(std::string_view bytes, std::string_view name);
TriangleMesh parse_off(std::string_view bytes, std::string_view name);
TriangleMesh parse_ply(std::string_view bytes, std::string_view name);
TriangleMesh parse_stl(std::string_view bytes, std::string_view name);
/// The triangles of the default scene where its nodes put them, of GLB and of text.
/// @param folder  where buffers of their own are looked for; none: such files are refused
TriangleMesh parse_gltf(std::string_view bytes, std::string_view name,
                        const std::optional<std::filesystem::path>& folder = std::nullopt);

}  // namespace weft
