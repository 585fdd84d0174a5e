#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

#include "weft/run.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

/// The number behind a word of a file, or the first of all without one. Nothing for "max", which is
/// how control groups write that there is no limit.
std::optional<std::uint64_t> number_in(const fs::path& path, std::string_view key = {}) {
  std::ifstream in(path);
  std::string word;
  std::uint64_t value = 0;
  while (!key.empty() && in >> word && word != key) continue;
  if (in >> value) return value;
  return std::nullopt;
}

/// Where the process stands among the groups: the path of "0::/path" or of "4:memory:/path".
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

/// What a group's limit leaves; files that the system may drop from its cache count as free.
std::optional<std::uint64_t> left_in(const fs::path& group, const GroupFiles& files) {
  const auto limit = number_in(group / files.limit), used = number_in(group / files.used);
  if (!limit || !used) return std::nullopt;
  const std::uint64_t cache = number_in(group / "memory.stat", files.cache_key).value_or(0);
  const std::uint64_t held = *used - std::min(cache, *used);
  return *limit - std::min(held, *limit);
}

}  // namespace

std::optional<std::uint64_t> available_memory(const fs::path& root) {
  std::optional<std::uint64_t> least = number_in(root / "proc/meminfo", "MemAvailable:");
  if (least) *least *= 1024;
  for (const GroupFiles& files : versions) {
    // A limit on a group holds for all groups below it. In a container the path may lead nowhere.
    fs::path group = group_of(root, files.controller);
    for (;; group = group.parent_path()) {
      const auto left = left_in(root / files.folder / group, files);
      if (left) least = std::min(least.value_or(*left), *left);
      if (group.empty()) break;
    }
  }
  return least;
}

}  // namespace weft
