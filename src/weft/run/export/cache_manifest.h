#pragma once

#include <span>

#include "weft/run/export/surface_record.h"

namespace weft {

/// What a run's exports are, for programs and people that open them: unit, axes, rate, frame range,
/// and each file with its format, vertex count and whose vertices they are.
struct CacheManifest {
  MeshFrame files;
  double frame_rate = 60;  ///< [1/s]
  int frames = 1;          ///< frame 0 included
  std::vector<const SurfaceRecord*> cloths{}, bodies{};
};
/// As JSON. Files that the manifest there before names, and the new one does not, are removed: they
/// show another run.
/// @param inputs  files that are never removed  @throws OutputError
void write_cache_manifest(const std::filesystem::path& path, const CacheManifest& manifest,
                          std::span<const std::filesystem::path> inputs);

}  // namespace weft
