#include <algorithm>
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
#include "weft/mesh_colours.h"

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

TriangleMesh in_metres_y_up(TriangleMesh mesh, const MeshFrame& frame) {
  for (Vec3d& p : mesh.positions) p = in_metres_y_up(p, frame);
  return mesh;
}

std::optional<LengthUnit> find_length_unit(std::string_view name) {
  for (const LengthUnit& unit : length_units)
    if (unit.name == name) return unit;
  return std::nullopt;
}

Box3d box_of(const TriangleMesh& mesh) {
  const auto is_finite = [](Vec3d p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  Box3d box;
  for (const Triangle& t : mesh.triangles)
    for (const int v : t)
      if (is_finite(mesh.positions[v])) box.add(mesh.positions[v]);
  return box;
}

std::optional<std::string> implausible_size(const TriangleMesh& mesh, const LengthUnit& taken) {
  constexpr double min = 0.05, max = 10;
  // The range of most garments and bodies: a wider one would make the guess of the unit useless.
  constexpr double likely_min = 0.3, likely_max = 3;
  const Box3d box = box_of(mesh);
  if (box.empty()) return std::nullopt;
  const Vec3d extent = box.extent();
  const double side = std::max({extent.x, extent.y, extent.z});
  if (!(side > 0) || (side >= min && side <= max)) return std::nullopt;
  const double in_file = side / taken.metres;
  const auto* const likely =
      std::find_if(length_units.begin(), length_units.end(), [&](const LengthUnit& unit) {
        return in_file * unit.metres >= likely_min && in_file * unit.metres <= likely_max;
      });
  return fmt::format(
      "its largest side is {:.3g} m, which is {} for a garment or a body; {}", side,
      side < min ? "small" : "large",
      likely != length_units.end()
          ? fmt::format("--unit {} would make it {:.3g} m", likely->name, in_file * likely->metres)
          : "--unit m|cm|mm|in says what its numbers mean");
}

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

std::string obj_text(const TriangleMesh& mesh, std::span<const Vec3f> colours) {
  std::string text;
  const auto out = std::back_inserter(text);
  // fmt gives the shortest decimals that read back as the same double.
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3d& p = mesh.positions[v];
    fmt::format_to(out, "v {} {} {}", p.x, p.y, p.z);
    if (!colours.empty())
      for (const std::uint8_t value : display_bytes(colours[v]))
        fmt::format_to(out, " {:.4g}", value / 255.0);
    text.push_back('\n');
  }
  const MeshFaces faces = faces_of(mesh);
  for (const Vec2f uv : faces.texture) fmt::format_to(out, "vt {} {}\n", uv.x, uv.y);
  for (std::size_t corner = 0; corner < faces.corners.size(); ++corner) {
    text += corner % 3 == 0 ? "f " : " ";
    fmt::format_to(out, "{}", faces.corners[corner] + 1);
    if (!faces.texture.empty()) fmt::format_to(out, "/{}", faces.texture_corners[corner] + 1);
    if (corner % 3 == 2) text.push_back('\n');
  }
  return text;
}

std::string ply_bytes(const TriangleMesh& mesh, std::span<const Vec3f> colours) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n{}"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(),
      colours.empty() ? "" : "property uchar red\nproperty uchar green\nproperty uchar blue\n",
      mesh.triangles.size());
  bytes.reserve(bytes.size() + 27 * mesh.positions.size() + 13 * mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3d& p = mesh.positions[v];
    for (const double x : {p.x, p.y, p.z})
      append_little_endian(bytes, __builtin_bit_cast(std::uint64_t, x));
    if (!colours.empty())
      for (const std::uint8_t value : display_bytes(colours[v]))
        bytes.push_back(static_cast<char>(value));
  }
  for (const Triangle& t : mesh.triangles) {
    bytes.push_back(3);
    for (const int v : t) append_little_endian(bytes, static_cast<std::uint32_t>(v));
  }
  return bytes;
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                std::span<const Vec3f> colours) {
  const std::string ending = ending_of(path);
  if (ending != ".obj" && ending != ".ply")
    throw UsageError(path.string(), "a mesh cannot be written with the ending '" + ending + "'",
                     ".obj or .ply is wanted");
  const std::string bytes = ending == ".obj" ? obj_text(mesh, colours) : ply_bytes(mesh, colours);
  write_file(path, [&](std::ostream& out) { out << bytes; });
}

}  // namespace weft
