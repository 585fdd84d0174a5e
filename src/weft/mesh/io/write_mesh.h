#pragma once

#include <filesystem>
#include <string>

#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// Writes OBJ or PLY (binary, double precision) by the ending of the name. Numbers are written so
/// that reading them back gives the same bits. @throws OutputError; UsageError on another ending
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

/// The same in memory.
std::string obj_text(const TriangleMesh& mesh);
std::string ply_bytes(const TriangleMesh& mesh);

}  // namespace weft
