#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
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

/// How a motion becomes samples whose file holds curves of time (glTF).
struct MotionSampling {
  std::string clip{};      ///< name of the animation; empty: the first
  double frame_rate = 60;  ///< samples a second
  /// Samples are at whole frames after this time, besides the first and the last. [s]
  double lead_in = 0;
};

/// Reads the motion of a mesh's vertices by the ending of the name: PC2, MDD, NPZ, the animation of
/// a GLB or glTF file, or a sequence of OBJ, OFF or PLY files (`body_%04d.obj`). The start time in
/// the file is ignored: the first sample has time 0.
/// @param sampling  for GLB and glTF
/// @throws InputError for what is missing, not whole, longer than it says, not finite or above
/// 1e30, without points or samples, with times that do not ascend, of a type or shape that is not
/// wanted, or without the animation that is asked for; for sequences with gaps or of files of
/// different numbers of vertices
PointCache read_point_cache(const std::filesystem::path& path, const MotionSampling& sampling = {});

/// Reads a point cache from memory; `name` is what errors call it. PC2 is little-endian with times
/// in frames, MDD is big-endian with times in seconds.
PointCache parse_pc2(std::string_view bytes, std::string_view name);
PointCache parse_mdd(std::string_view bytes, std::string_view name);
/// An archive of numpy's (.npz): `vertices` [samples, points, 3] of float32 or float64, in frames,
/// or in seconds where `frame_rate` or `fps` is there, one number. Python objects are never
/// unpickled.
PointCache parse_npz(std::string_view bytes, std::string_view name);
/// An animation of a GLB or glTF file: the vertices are those that parse_gltf gives.
/// @param folder  where external buffers are looked for; none: they are refused
PointCache parse_gltf_motion(std::string_view bytes, std::string_view name,
                             const MotionSampling& sampling,
                             const std::optional<std::filesystem::path>& folder = std::nullopt);

/// The files that a point cache is read from: one, or those of a sequence, or a glTF file with its
/// external buffers. @throws InputError as read_point_cache where these cannot be told
std::vector<std::filesystem::path> point_cache_files(const std::filesystem::path& path);

/// Memory that the samples of a point cache take, or a bound on it. [bytes]
/// @throws InputError as read_point_cache where this cannot be told
std::uint64_t point_cache_bytes(const std::filesystem::path& path, const MotionSampling& sampling);

/// Refuses a point cache that no file could hold, as one made by a caller may be.
/// @param name  of the cache in the error
/// @throws InputError for no points or samples, another number of positions than those make, times
///         that do not ascend from 0, or positions that are not finite or above 1e30
void check_point_cache(const PointCache& cache, std::string_view name);

/// True when a name is that of a file that read_point_cache reads, or of numbered ones.
bool is_point_cache_name(const std::filesystem::path& name);
/// True when a name ends as those of glTF files do, which hold meshes and animations by their
/// names.
bool is_gltf_name(const std::filesystem::path& name);
/// What is_point_cache_name asks for, in words for error messages.
inline constexpr std::string_view point_cache_wanted =
    "a motion, .pc2, .mdd, .npz, .glb, .gltf or numbered meshes (body_%04d.obj), is wanted";

}  // namespace weft
