#include "weft/point_cache.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/mesh/io/byte_reader.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/mesh_sequence.h"
#include "weft/mesh/io/motion_files.h"
#include "weft/mesh/io/pc2_header.h"

namespace weft {
namespace {

constexpr std::size_t mdd_header = 8;
constexpr std::size_t word = 4, point_size = 3 * word;

/// The counts of points and samples in a header.
struct CacheCounts {
  std::uint64_t points, samples;
};

/// Checks a header's counts against the length of the file, before anything is allocated.
/// @param bytes_per_sample  besides its points
void check_length(std::string_view bytes, std::string_view name, CacheCounts counts,
                  std::size_t header, std::size_t bytes_per_sample) {
  constexpr std::uint64_t max = INT32_MAX;
  if (counts.points < 1 || counts.points > max || counts.samples < 1 || counts.samples > max)
    throw InputError(name, fmt::format("{} points and {} samples", counts.points, counts.samples),
                     "at least one of each is wanted");
  const std::uint64_t sample_bytes = bytes_per_sample + point_size * counts.points;
  const std::uint64_t body = bytes.size() - header;
  if (body / sample_bytes == counts.samples && body % sample_bytes == 0) return;
  throw InputError(name,
                   fmt::format("is {} bytes long with {} points and {} samples", bytes.size(),
                               counts.points, counts.samples),
                   "a whole point cache is wanted");
}

std::uint64_t bytes_of(const std::filesystem::path& path) {
  std::error_code missing;  // reported when it is read
  const std::uintmax_t bytes = std::filesystem::file_size(path, missing);
  return missing ? 0 : bytes;
}

/// @param bytes  exactly the points
void read_points(std::string_view bytes, std::string_view name, bool big_endian,
                 PointCache& cache) {
  cache.positions.reserve(bytes.size() / point_size);
  for (std::size_t at = 0; at < bytes.size(); at += point_size) {
    const Vec3f p{load_float(bytes.substr(at), big_endian),
                  load_float(bytes.substr(at + word), big_endian),
                  load_float(bytes.substr(at + 2 * word), big_endian)};
    for (const float x : {p.x, p.y, p.z}) {
      const std::string_view fault = coordinate_fault(x);
      if (fault.empty()) continue;
      const std::size_t index = at / point_size, points = cache.points;
      throw InputError(name,
                       fmt::format("a coordinate of point {} in sample {} {}", index % points,
                                   index / points, fault),
                       "finite numbers are wanted");
    }
    cache.positions.push_back(p);
  }
}

}  // namespace

PointCache parse_pc2(std::string_view bytes, std::string_view name) {
  Pc2Header header;
  if (bytes.size() >= sizeof(header)) std::memcpy(&header, bytes.data(), sizeof(header));
  if (bytes.size() < sizeof(header) || !header.is_known())
    throw InputError(name, "does not begin as a PC2 file does", "a point cache is wanted");
  const auto version = static_cast<std::uint32_t>(header.version);
  if (version != 1)
    throw InputError(name, fmt::format("PC2 version {}", version), "version 1 is wanted");
  const CacheCounts counts{static_cast<std::uint32_t>(header.points),
                           static_cast<std::uint32_t>(header.samples)};
  check_length(bytes, name, counts, sizeof(header), 0);
  const double step = header.step;
  if (!(step > 0 && step <= 1e6))
    throw InputError(name, fmt::format("{} frames between two samples", step),
                     "a number > 0 is wanted");
  PointCache cache;
  cache.points = static_cast<int>(counts.points);
  cache.times_in_frames = true;
  for (std::uint64_t k = 0; k < counts.samples; ++k)
    cache.times.push_back(step * static_cast<double>(k));
  read_points(bytes.substr(sizeof(header)), name, false, cache);
  return cache;
}

PointCache parse_mdd(std::string_view bytes, std::string_view name) {
  if (bytes.size() < mdd_header)
    throw InputError(name, fmt::format("is {} bytes long", bytes.size()),
                     "a whole MDD file is wanted");
  const CacheCounts counts{load_integer<std::uint32_t>(bytes.substr(word), true),
                           load_integer<std::uint32_t>(bytes, true)};
  check_length(bytes, name, counts, mdd_header, word);
  PointCache cache;
  cache.points = static_cast<int>(counts.points);
  const double first = load_float(bytes.substr(mdd_header), true);
  for (std::uint64_t k = 0; k < counts.samples; ++k) {
    const double time = load_float(bytes.substr(mdd_header + word * k), true) - first;
    if (!(k == 0 ? time == 0 : time > cache.times.back() && time <= 1e9))
      throw InputError(name, fmt::format("the time of sample {} does not follow", k),
                       "ascending times are wanted");
    cache.times.push_back(time);
  }
  read_points(bytes.substr(mdd_header + word * counts.samples), name, true, cache);
  return cache;
}

void check_point_cache(const PointCache& cache, std::string_view name) {
  const std::size_t points = cache.points < 0 ? 0 : static_cast<std::size_t>(cache.points);
  if (points < 1 || cache.times.empty() || cache.positions.size() != points * cache.times.size())
    throw InputError(name,
                     fmt::format("{} positions for {} points and {} samples",
                                 cache.positions.size(), cache.points, cache.times.size()),
                     "as many as both make, at least one of each, are wanted");
  for (std::size_t k = 0; k < cache.times.size(); ++k)
    if (!(k == 0 ? cache.times[k] == 0 : cache.times[k] > cache.times[k - 1]))
      throw InputError(name, fmt::format("the time of sample {} does not follow", k),
                       "ascending times from 0 are wanted");
  for (std::size_t i = 0; i < cache.positions.size(); ++i)
    for (const float x : {cache.positions[i].x, cache.positions[i].y, cache.positions[i].z})
      if (const std::string_view fault = coordinate_fault(x); !fault.empty())
        throw InputError(
            name,
            fmt::format("a coordinate of point {} in sample {} {}", i % points, i / points, fault),
            "finite numbers are wanted");
}

bool is_gltf_name(const std::filesystem::path& name) {
  const std::string ending = ending_of(name);
  return ending == ".glb" || ending == ".gltf";
}

bool is_point_cache_name(const std::filesystem::path& name) {
  const std::string ending = ending_of(name);
  return ending == ".pc2" || ending == ".mdd" || ending == ".npz" || is_gltf_name(name) ||
         is_mesh_sequence_name(name);
}

PointCache read_point_cache(const std::filesystem::path& path, const MotionSampling& sampling) {
  if (is_mesh_sequence_name(path)) return read_mesh_sequence(path);
  const std::string bytes = read_file(path), ending = ending_of(path);
  if (ending == ".pc2") return parse_pc2(bytes, path.string());
  if (ending == ".mdd") return parse_mdd(bytes, path.string());
  if (ending == ".npz") return parse_npz(bytes, path.string());
  if (is_gltf_name(path))
    return parse_gltf_motion(bytes, path.string(), sampling, path.parent_path());
  throw InputError(path.string(), "the ending '" + ending + "' is not that of a motion",
                   point_cache_wanted);
}

std::vector<std::filesystem::path> point_cache_files(const std::filesystem::path& path) {
  if (is_mesh_sequence_name(path)) return find_mesh_sequence(path).files;
  if (is_gltf_name(path)) return gltf_files(path);
  return {path};
}

std::uint64_t point_cache_bytes(const std::filesystem::path& path, const MotionSampling& sampling) {
  if (is_gltf_name(path)) return gltf_motion_bytes(path, sampling);
  std::uint64_t bytes = 0;
  // A vertex of a numbered mesh takes about as much as three floats, or more: 12 bytes in binary
  // files, as text more than that but for very short numbers.
  for (const std::filesystem::path& file : point_cache_files(path))
    bytes += ending_of(path) == ".npz" ? npz_motion_bytes(file) : bytes_of(file);
  return bytes;
}

}  // namespace weft
