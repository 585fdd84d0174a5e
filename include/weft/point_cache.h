#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "weft/vec.h"

namespace weft {

/// A point cache: the positions of all vertices of a moving mesh at ascending times.
struct PointCache {
  int points = 0;
  bool times_in_frames = false;  ///< whose length is not in the file; otherwise seconds
  std::vector<double> times;     ///< [samples] from the first sample's, which is 0
  std::vector<Vec3f> positions;  ///< [samples * points], sample by sample, in the mesh's unit

  [[nodiscard]] int samples() const { return static_cast<int>(times.size()); }
  [[nodiscard]] std::span<const Vec3f> sample(int index) const {
    const auto count = static_cast<std::size_t>(points);
    return std::span(positions).subspan(static_cast<std::size_t>(index) * count, count);
  }
};

/// Reads PC2 or MDD by the ending of the name. The start time in the file is ignored: the first
/// sample has time 0.
/// @throws InputError for what is missing, not whole, longer than it says, not finite or above
/// 1e30, without points or samples, or with times that do not ascend
PointCache read_point_cache(const std::filesystem::path& path);

/// Reads a point cache from memory; `name` is what errors call it. PC2 is little-endian with times
/// in frames, MDD is big-endian with times in seconds.
PointCache parse_pc2(std::string_view bytes, std::string_view name);
PointCache parse_mdd(std::string_view bytes, std::string_view name);

/// Refuses a point cache that no file could hold, as one made by a caller may be.
/// @param name  of the cache in the error
/// @throws InputError for no points or samples, another number of positions than those make, times
///         that do not ascend from 0, or positions that are not finite or above 1e30
void check_point_cache(const PointCache& cache, std::string_view name);

/// True when a name ends as point caches do: .pc2 or .mdd.
bool is_point_cache_name(const std::filesystem::path& name);

}  // namespace weft
