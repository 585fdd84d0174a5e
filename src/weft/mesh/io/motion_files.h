#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "weft/point_cache.h"

namespace weft {

/// Of the motions in some formats, what point_cache_files and point_cache_bytes tell.
/// @throws InputError as their readers
std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& path);
std::uint64_t gltf_motion_bytes(const std::filesystem::path& path, const MotionSampling& sampling);
/// The unpacked size of the vertices.
std::uint64_t npz_motion_bytes(const std::filesystem::path& path);

}  // namespace weft
