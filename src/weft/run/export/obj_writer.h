#pragma once

#include <filesystem>

#include "weft/run/export/exported_surface.h"

namespace weft {

/// Writes an OBJ: positions, texture coordinates where there are some, a smooth normal for each
/// vertex, polygons. @param points  [vertices]  @throws OutputError
void write_obj(const std::filesystem::path& path, const ExportedSurface& surface,
               std::span<const Vec3f> points);

}  // namespace weft
