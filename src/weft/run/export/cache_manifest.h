#pragma once

#include <span>

#include "weft/run/export/surface_record.h"

namespace weft {

/// Description of a run's exports, for programs and people that open them: unit, axes, rate, frame
/// range, and each file with its format, vertex count and whether its vertices are those of the
/// image or the input.
struct CacheManifest {
  MeshFrame files;
  double frame_rate = 60;  ///< [1/s]
  int frames = 1;          ///< frame 0 included
  std::vector<const SurfaceRecord*> cloths{}, bodies{};
};
/// Writes the manifest as JSON. Files that only the previous manifest names show another run and
/// are removed.
/// @param inputs  files that are never removed  @throws OutputError
void write_cache_manifest(const std::filesystem::path& path, const CacheManifest& manifest,
                          std::span<const std::filesystem::path> inputs);

}  // namespace weft
