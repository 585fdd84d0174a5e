#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/motion_files.h"
#include "weft/mesh/io/npy_array.h"
#include "weft/mesh/io/zip_file.h"
#include "weft/point_cache.h"

namespace weft {
namespace {

const ZipMember* find(const std::vector<ZipMember>& members, std::string_view array) {
  for (const ZipMember& member : members)
    if (member.name == fmt::format("{}.npy", array)) return &member;
  return nullptr;
}

std::string names_of(const std::vector<ZipMember>& members) {
  std::vector<std::string> names;
  names.reserve(members.size());
  for (const ZipMember& member : members) names.push_back(member.name);
  return names.empty() ? "nothing" : quoted_list(names);
}

/// Frames a second, where the file says so.
std::optional<double> frame_rate_of(const std::vector<ZipMember>& members, std::string_view name) {
  for (const std::string_view key : {"frame_rate", "fps"}) {
    const ZipMember* member = find(members, key);
    if (member == nullptr) continue;
    const std::string bytes = unpack(*member, name);
    const NpyArray array = parse_npy(bytes, fmt::format("{}: {}", name, key));
    const double rate = array.count() == 1 ? array.at(0) : 0;
    if (!(rate >= 1e-6 && rate <= 1e6))
      throw InputError(name, fmt::format("{} is no frame rate", key),
                       "one number from 1e-6 to 1e6 is wanted");
    return rate;
  }
  return std::nullopt;
}

void check_vertices(const NpyArray& array, std::string_view name) {
  if (array.kind != NpyArray::Kind::floating)
    throw InputError(name, "vertices holds whole numbers", "float32 or float64 is wanted");
  const std::vector<std::size_t>& shape = array.shape;
  if (shape.size() != 3 || shape[2] != 3 || array.count() == 0)
    throw InputError(name, fmt::format("vertices has the shape {}", shape_text(shape)),
                     "(frames, vertices, 3) is wanted");
  if (shape[0] > INT32_MAX || shape[1] > INT32_MAX)
    throw InputError(name, fmt::format("vertices has the shape {}", shape_text(shape)),
                     "fewer frames and vertices are wanted");
}

Vec3f position_at(const NpyArray& array, std::size_t frame, std::size_t vertex,
                  std::string_view name) {
  const std::size_t frames = array.shape[0], vertices = array.shape[1];
  const std::size_t first =
      array.fortran_order ? frame + frames * vertex : 3 * (frame * vertices + vertex);
  const std::size_t step = array.fortran_order ? frames * vertices : 1;
  const Vec3d p{array.at(first), array.at(first + step), array.at(first + 2 * step)};
  for (const double x : {p.x, p.y, p.z})
    if (const std::string_view fault = coordinate_fault(x); !fault.empty())
      throw InputError(
          name, fmt::format("a coordinate of point {} in sample {} {}", vertex, frame, fault),
          "finite numbers are wanted");
  return vec_cast<float>(p);
}

}  // namespace

std::uint64_t npz_motion_bytes(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  for (const ZipMember& member : zip_members(bytes, path.string()))
    if (member.name == "vertices.npy") return member.size;
  return 0;
}

PointCache parse_npz(std::string_view bytes, std::string_view name) {
  const std::vector<ZipMember> members = zip_members(bytes, name);
  const ZipMember* member = find(members, "vertices");
  if (member == nullptr)
    throw InputError(name, fmt::format("holds {}", names_of(members)),
                     "an array 'vertices' of the shape (frames, vertices, 3) is wanted");
  const std::optional<double> rate = frame_rate_of(members, name);
  const std::string unpacked = unpack(*member, name);
  const NpyArray array = parse_npy(unpacked, fmt::format("{}: vertices", name));
  check_vertices(array, name);
  PointCache cache;
  cache.points = static_cast<int>(array.shape[1]);
  cache.times_in_frames = !rate;
  cache.positions.reserve(array.shape[0] * array.shape[1]);
  for (std::size_t k = 0; k < array.shape[0]; ++k) {
    cache.times.push_back(static_cast<double>(k) / rate.value_or(1));
    for (std::size_t v = 0; v < array.shape[1]; ++v)
      cache.positions.push_back(position_at(array, k, v, name));
  }
  return cache;
}

}  // namespace weft
