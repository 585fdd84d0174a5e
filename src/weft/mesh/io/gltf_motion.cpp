#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/mesh/io/gltf_document.h"
#include "weft/mesh/io/gltf_rig.h"
#include "weft/mesh/io/motion_files.h"
#include "weft/point_cache.h"

namespace weft {
namespace {

constexpr double max_positions = 500'000'000;  ///< of a sampled motion: 6 GB

/// Times from 0 to the end of a rig's animation, of which all but the first and the last are those
/// of whole frames after the lead-in.
std::vector<double> sample_times(const GltfRig& rig, const MotionSampling& sampling) {
  const double rate = sampling.frame_rate;
  if (!(rig.duration * rate * rig.points() < max_positions))
    throw InputError(
        rig.name,
        fmt::format("an animation of {:.6g} s, at {:g} frames a second and {} vertices",
                    rig.duration, rate, rig.points()),
        "a shorter one is wanted");
  // Of a frame. Keys are in single precision: one that is meant to be a frame lies a little beside.
  const double rounding = 1e-6 + 2.5e-7 * rig.duration * rate;
  const double lead = sampling.lead_in * rate;
  if (!(lead < max_positions))
    throw InputError(rig.name, fmt::format("a lead-in of {:g} frames", lead),
                     "a shorter one is wanted");
  std::vector<double> times{0};
  for (double frame = std::floor(lead + rounding) + 1;
       frame - lead < rig.duration * rate - rounding; ++frame)
    times.push_back((frame - lead) / rate);
  if (rig.duration * rate > rounding) times.push_back(rig.duration);
  return times;
}

}  // namespace

PointCache parse_gltf_motion(std::string_view bytes, std::string_view name,
                             const MotionSampling& sampling,
                             const std::optional<std::filesystem::path>& folder) {
  const GltfRig rig = read_gltf_rig(bytes, name, sampling.clip, folder);
  PointCache cache;
  cache.points = rig.points();
  cache.times = sample_times(rig, sampling);
  cache.positions.reserve(cache.times.size() * static_cast<std::size_t>(cache.points));
  for (const double time : cache.times)
    for (const Vec3d& p : positions_at(rig, time)) cache.positions.push_back(vec_cast<float>(p));
  check_point_cache(cache, name);
  return cache;
}

std::uint64_t gltf_motion_bytes(const std::filesystem::path& path, const MotionSampling& sampling) {
  const GltfRig rig =
      read_gltf_rig(read_file(path), path.string(), sampling.clip, path.parent_path());
  return sample_times(rig, sampling).size() * static_cast<std::uint64_t>(rig.points()) *
         sizeof(Vec3f);
}

std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& path) {
  const std::string bytes = read_file(path), name = path.string();
  GltfDocument document(bytes, name, path.parent_path());
  std::vector<std::filesystem::path> files{path};
  for (const std::filesystem::path& file : document.buffers().external_files())
    if (std::filesystem::exists(path.parent_path() / file))  // others were not needed
      files.push_back(path.parent_path() / file);
  return files;
}

}  // namespace weft
