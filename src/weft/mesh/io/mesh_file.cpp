#include <array>
#include <cctype>
#include <cstdint>
#include <iterator>
#include <ostream>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/mesh.h"

namespace weft {

namespace {

using Parser = TriangleMesh (*)(std::string_view, std::string_view);

TriangleMesh parse_by_ending(std::string_view bytes, const std::filesystem::path& path) {
  constexpr std::array<std::pair<std::string_view, Parser>, 4> parsers{
      {{".obj", parse_obj}, {".off", parse_off}, {".ply", parse_ply}, {".stl", parse_stl}}};
  const std::string ending = ending_of(path);
  for (const auto& [known, parser] : parsers)
    if (known == ending) return parser(bytes, path.string());
  if (ending == ".glb" || ending == ".gltf")
    return parse_gltf(bytes, path.string(), path.parent_path());
  throw InputError(path.string(), "the ending '" + ending + "' is not that of a mesh",
                   ".obj, .off, .ply, .stl, .glb or .gltf is wanted");
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& path) {
  // A missing file or a folder is reported before a wrong ending.
  const std::string bytes = read_file(path);
  return parse_by_ending(bytes, path);
}

namespace {

template <class Unsigned>
void append_little_endian(std::string& bytes, Unsigned value) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
    bytes.push_back(static_cast<char>((value >> (8 * i)) & 0xffU));
}

}  // namespace

std::string obj_text(const TriangleMesh& mesh) {
  std::string text;
  const auto out = std::back_inserter(text);
  // fmt gives the shortest decimals that read back as the same double.
  for (const Vec3d& p : mesh.positions) fmt::format_to(out, "v {} {} {}\n", p.x, p.y, p.z);
  for (const Triangle& t : mesh.triangles)
    fmt::format_to(out, "f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string ply_bytes(const TriangleMesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(), mesh.triangles.size());
  bytes.reserve(bytes.size() + 24 * mesh.positions.size() + 13 * mesh.triangles.size());
  for (const Vec3d& p : mesh.positions)
    for (const double x : {p.x, p.y, p.z})
      append_little_endian(bytes, __builtin_bit_cast(std::uint64_t, x));
  for (const Triangle& t : mesh.triangles) {
    bytes.push_back(3);
    for (const int v : t) append_little_endian(bytes, static_cast<std::uint32_t>(v));
  }
  return bytes;
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const std::string ending = ending_of(path);
  if (ending != ".obj" && ending != ".ply")
    throw UsageError(path.string(), "a mesh cannot be written with the ending '" + ending + "'",
                     ".obj or .ply is wanted");
  const std::string bytes = ending == ".obj" ? obj_text(mesh) : ply_bytes(mesh);
  write_file(path, [&](std::ostream& out) { out << bytes; });
}

}  // namespace weft
