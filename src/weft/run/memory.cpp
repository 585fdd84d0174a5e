#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "weft/convert.h"
#include "weft/error.h"
#include "weft/garment.h"
#include "weft/image_file.h"
#include "weft/point_cache.h"
#include "weft/run.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

/// The number after a key in a file, or the first one without a key. Nothing for "max", which is
/// how control groups write that there is no limit.
std::optional<std::uint64_t> number_in(const fs::path& path, std::string_view key = {}) {
  std::ifstream in(path);
  std::string word;
  std::uint64_t value = 0;
  while (!key.empty() && in >> word && word != key) continue;
  if (in >> value) return value;
  return std::nullopt;
}

/// Control group of the process: the path of "0::/path" or of "4:memory:/path".
fs::path group_of(const fs::path& root, std::string_view controller) {
  std::ifstream in(root / "proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == line.npos) continue;
    if (std::string_view(line).substr(first + 1, second - first - 1) == controller)
      return fs::path(line.substr(second + 1)).relative_path();
  }
  return {};
}

struct GroupFiles {
  const char *folder, *controller, *limit, *used, *cache_key;
};
constexpr GroupFiles versions[] = {
    {"sys/fs/cgroup", "", "memory.max", "memory.current", "inactive_file"},
    {"sys/fs/cgroup/memory", "memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
     "total_inactive_file"}};

/// Memory left below the limit of a group; cached files that the system may drop count as free.
std::optional<std::uint64_t> left_in(const fs::path& group, const GroupFiles& files) {
  const auto limit = number_in(group / files.limit), used = number_in(group / files.used);
  if (!limit || !used) return std::nullopt;
  const std::uint64_t cache = number_in(group / "memory.stat", files.cache_key).value_or(0);
  const std::uint64_t held = *used - std::min(cache, *used);
  return *limit - std::min(held, *limit);
}

}  // namespace

std::optional<std::uint64_t> available_memory(const fs::path& root) {
  std::optional<std::uint64_t> min = number_in(root / "proc/meminfo", "MemAvailable:");
  if (min) *min *= 1024;
  for (const GroupFiles& files : versions) {
    // A limit on a group holds for all groups below it. In a container the path may lead nowhere.
    fs::path group = group_of(root, files.controller);
    for (;; group = group.parent_path()) {
      const auto left = left_in(root / files.folder / group, files);
      if (left) min = std::min(min.value_or(*left), *left);
      if (group.empty()) break;
    }
  }
  return min;
}
namespace {

// Measured as the peak memory of runs, by size; the test of the program checks these again.
constexpr double program_bytes = 10e6;
constexpr double body_bytes_per_sample = 370;
/// Polar tables, one for every pair of a cloth and a body.
constexpr double table_bytes_per_sample = 110;
/// Trees of the other colliders.
constexpr double colliding_cloth_bytes_per_sample = 420, colliding_body_bytes_per_sample = 430;
/// Memory of the intersection count.
constexpr double counted_cloth_bytes_per_sample = 440;
/// Of a moving body: rest, both ends of a step, and the blend of each sample.
constexpr double moving_bytes_per_sample = 64;
/// Of one that changes its shape, beside that: where it lies in itself, and where it began.
constexpr double deforming_bytes_per_sample = 182;
constexpr double margin = 1.25, short_share = 0.8;

double animation_bytes(const Animation& animation, const MotionSampling& sampling) {
  if (animation.in_memory())
    return static_cast<double>(animation.points->positions.size() * sizeof(Vec3f));
  try {
    return static_cast<double>(point_cache_bytes(animation.name, sampling));
  } catch (const InputError&) {
    return 0;  // reported when it is read
  }
}

int size_of(const Surface& surface, int size) {
  const bool is_file = !surface.in_memory() && is_image_name(surface.name);
  return surface.image ? surface.image->size() : is_file ? read_image(surface.name).size() : size;
}

int size_of(const SceneCloth& cloth) {
  if (cloth.surface.in_memory() || !is_pattern_name(cloth.surface.name))
    return size_of(cloth.surface, cloth.size);
  try {
    return min_garment_size(read_pattern(cloth.surface.name), cloth.spacing);
  } catch (const InputError&) {
    return cloth.size;  // reported when it is made
  }
}

}  // namespace

std::uint64_t estimate_memory(const Scene& scene) {
  LoadedSizes sizes;
  for (const SceneCloth& cloth : scene.cloths) sizes.cloths.push_back(size_of(cloth));
  for (const SceneBody& body : scene.bodies)
    sizes.bodies.push_back(size_of(body.surface, body.size));
  return estimate_memory(scene, sizes);
}

std::uint64_t estimate_memory(const Scene& scene, const LoadedSizes& sizes) {
  const auto squared = [](int size) { return static_cast<double>(size) * size; };
  double bytes = program_bytes;
  const bool filtered = Colliders::traits_of(scene.collider).filters;
  const IntegratorTraits needs = Integrators::traits_of(scene.integrator);
  for (const int size : sizes.cloths) {
    const double samples = squared(size);
    bytes += needs.bytes_per_sample * samples + needs.bytes_per_pair * samples * samples;
    bytes += counted_cloth_bytes_per_sample * samples;
    if (filtered) bytes += colliding_cloth_bytes_per_sample * samples;
  }
  const double per_body_sample =
      body_bytes_per_sample +
      (filtered ? colliding_body_bytes_per_sample
                : table_bytes_per_sample * static_cast<double>(scene.cloths.size()));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    const double samples = squared(sizes.bodies[i]);
    bytes += per_body_sample * samples;
    if (!body.motion.empty() || !body.animation.empty()) bytes += moving_bytes_per_sample * samples;
    if (!body.animation.empty())
      bytes += deforming_bytes_per_sample * samples +
               animation_bytes(body.animation,
                               {body.animation.clip, scene.frame_rate, body.wait + body.lead_in});
  }
  return static_cast<std::uint64_t>(bytes);
}

void check_memory(std::uint64_t bytes, std::uint64_t available, const std::string& scene) {
  if (static_cast<double>(bytes) <= margin * static_cast<double>(available)) return;
  throw SceneError(scene,
                   fmt::format("about {} of memory are needed, {} are there", memory_text(bytes),
                               memory_text(available)),
                   "smaller sizes are wanted");
}

bool is_memory_short(std::uint64_t bytes, std::uint64_t available) {
  return static_cast<double>(bytes) > short_share * static_cast<double>(available);
}

std::string memory_text(std::uint64_t bytes) {
  const double mb = 1e-6 * static_cast<double>(bytes);
  return mb < 1000 ? fmt::format("{:.0f} MB", mb) : fmt::format("{:.1f} GB", mb / 1000);
}

}  // namespace weft
