#include "weft/mesh/io/mesh_sequence.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/mesh.h"
#include "weft/mesh/io/line_reader.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_digits = 9;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The number in a file's name; nothing for a name that is not of the sequence.
std::optional<int> number_in(const std::string& file, const SequenceName& name) {
  if (file.size() <= name.before.size() + name.behind.size() || !file.starts_with(name.before) ||
      !file.ends_with(name.behind))
    return std::nullopt;
  const std::string digits =
      file.substr(name.before.size(), file.size() - name.before.size() - name.behind.size());
  const auto min = static_cast<std::size_t>(name.digits);
  const bool plain = std::all_of(digits.begin(), digits.end(), is_digit);
  if (!plain || digits.size() < min || digits.size() > max_digits) return std::nullopt;
  if (digits.size() > min && digits[0] == '0') return std::nullopt;
  return static_cast<int>(*to_integer(digits));
}

std::map<int, fs::path> numbered_files(const fs::path& pattern, const SequenceName& name) {
  const fs::path folder = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
  std::map<int, fs::path> files;
  std::error_code fault;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end;
       entry.increment(fault))
    if (const auto number = number_in(entry->path().filename().string(), name))
      files[*number] = pattern.parent_path() / entry->path().filename();
  return files;
}

}  // namespace

std::optional<SequenceName> sequence_name(const fs::path& pattern) {
  const std::string name = pattern.filename().string();
  const std::size_t mark = name.find('%');
  if (mark == name.npos || name.find('%', mark + 1) != name.npos) return std::nullopt;
  std::size_t end = mark + 1;
  while (end < name.size() && is_digit(name[end])) ++end;
  if (end == name.size() || name[end] != 'd') return std::nullopt;
  const std::string width = name.substr(mark + 1, end - mark - 1);
  const bool plain = width.empty() || (width.size() == 2 && width[0] == '0' && width[1] > '0');
  if (!plain) return std::nullopt;
  return SequenceName{name.substr(0, mark), name.substr(end + 1),
                      width.empty() ? 1 : width[1] - '0'};
}

bool is_mesh_sequence_name(const fs::path& name) {
  const std::string ending = ending_of(name);
  return (ending == ".obj" || ending == ".off" || ending == ".ply") && sequence_name(name);
}

MeshSequence find_mesh_sequence(const fs::path& pattern) {
  const std::optional<SequenceName> name = sequence_name(pattern);
  if (!name)
    throw InputError(pattern.string(), "has no place for a number", "%d or %04d is wanted");
  const std::map<int, fs::path> files = numbered_files(pattern, *name);
  if (files.empty())
    throw InputError(pattern.string(), "no such files",
                     fmt::format("numbered files such as {}{:0{}}{} are wanted", name->before, 1,
                                 name->digits, name->behind));
  MeshSequence sequence;
  const int first = files.begin()->first;
  if (files.size() > 1) sequence.step = std::next(files.begin())->first - first;
  for (const auto& [number, file] : files) {
    const std::int64_t wanted =
        first + static_cast<std::int64_t>(sequence.files.size()) * sequence.step;
    if (number != wanted)
      throw InputError(pattern.string(),
                       fmt::format("number {} follows on {}", number, wanted - sequence.step),
                       fmt::format("number {}, or the same step all along, is wanted", wanted));
    sequence.files.push_back(file);
  }
  return sequence;
}

PointCache read_mesh_sequence(const fs::path& pattern) {
  const MeshSequence sequence = find_mesh_sequence(pattern);
  PointCache cache;
  cache.times_in_frames = true;
  for (const fs::path& file : sequence.files) {
    const TriangleMesh mesh = read_mesh(file);
    const auto points = static_cast<int>(mesh.positions.size());
    if (cache.times.empty()) cache.points = points;
    if (points != cache.points)
      throw InputError(file.string(), fmt::format("{} vertices", points),
                       fmt::format("{}, those of {}, are wanted", cache.points,
                                   sequence.files.front().filename().string()));
    cache.times.push_back(static_cast<double>(cache.times.size()) * sequence.step);
    for (const Vec3d& p : mesh.positions) cache.positions.push_back(vec_cast<float>(p));
  }
  return cache;
}

}  // namespace weft
