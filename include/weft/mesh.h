#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/vec.h"

namespace weft {

/// Three vertex indices, counter-clockwise seen from outside.
using Triangle = std::array<int, 3>;

/// A triangle mesh as a plain value; its topology may be anything until it is checked
/// (`weft/repair.h`).
struct TriangleMesh {
  std::vector<Vec3d> positions;     ///< [V], metres
  std::vector<Triangle> triangles;  ///< [F], indices into positions
  /// [F] texture coordinates of each triangle's corners; empty unless every corner has them. One
  /// vertex may have different ones in different triangles, at a texture seam.
  std::vector<std::array<Vec2f, 3>> corner_uv = {};
};

/// A unit of length with its name on the command line.
struct LengthUnit {
  std::string_view name;
  double metres = 1;
};
inline constexpr std::array<LengthUnit, 4> length_units{
    {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}}};
/// The unit of a name; nothing for an unknown one.
std::optional<LengthUnit> find_length_unit(std::string_view name);

/// Unit and up axis of the coordinates in a mesh file.
struct MeshFrame {
  LengthUnit unit = length_units[0];
  bool z_up = false;  ///< z points up, y away from the viewer
  [[nodiscard]] std::string_view up() const { return z_up ? "z" : "y"; }
};

/// Converts a mesh to metres with y up: (x, y, z) with z up becomes (x, z, -y).
TriangleMesh in_metres_y_up(TriangleMesh mesh, const MeshFrame& frame);

/// A point in the coordinates of a file: the inverse of in_metres_y_up, but for rounding.
/// @param point  y up [m]
inline Vec3d in_frame(Vec3d point, const MeshFrame& frame) {
  if (frame.z_up) point = {point.x, -point.z, point.y};
  return {point.x / frame.unit.metres, point.y / frame.unit.metres, point.z / frame.unit.metres};
}
/// A point of a file in metres with y up.
inline Vec3d in_metres_y_up(Vec3d point, const MeshFrame& frame) {
  point = frame.unit.metres * point;
  return frame.z_up ? Vec3d{point.x, point.z, -point.y} : point;
}

/// The box of the vertices that triangles have, of finite ones: files may hold others, anywhere.
Box3d box_of(const TriangleMesh& mesh);

/// A warning for a mesh whose largest side is below 5 cm or above 10 m, implausible for a garment
/// or a body, with the likely unit of its numbers; nothing for other meshes.
/// @param mesh  in metres by the unit `taken`
std::optional<std::string> implausible_size(const TriangleMesh& mesh, const LengthUnit& taken);

/// The faces of a mesh as its author made them: polygons of any number of corners, and texture
/// coordinates with indices of their own.
struct MeshFaces {
  std::vector<int> sizes;              ///< [P] corners of each polygon, >= 3
  std::vector<int> corners;            ///< [sum of sizes] vertices
  std::vector<Vec2f> texture{};        ///< [T] v runs upwards
  std::vector<int> texture_corners{};  ///< [sum of sizes] into texture, -1: none; or empty: no
                                       ///< corner has any
  /// Of polygons that no fan covers, since they are not convex, by number: their triangles, as
  /// places among the polygon's corners.
  std::map<int, std::vector<Triangle>> ears{};
  [[nodiscard]] bool has_texture() const { return !texture_corners.empty(); }
};

/// The triangles of a mesh as faces; equal texture coordinates of one vertex become one.
MeshFaces faces_of(const TriangleMesh& mesh);

/// Every polygon as a fan from its first corner, or as its ears: the order in which readers split
/// them.
struct FanCorners {
  std::vector<Triangle> triangles;  ///< vertices
  std::vector<Triangle> places;     ///< the same corners as places in MeshFaces::corners
};
FanCorners fans_of(const MeshFaces& faces);

/// A mesh file with its faces as they are written there.
struct MeshFile {
  TriangleMesh mesh;
  MeshFaces faces;
};
/// Polygons and texture indices are those of OBJ; faces of the other formats are triangles, as
/// read_mesh splits them. @throws as read_mesh
MeshFile read_mesh_file(const std::filesystem::path& path);
/// OBJ from memory; `name` is what errors call it.
MeshFile parse_obj_file(std::string_view bytes, std::string_view name);

/// Reads OBJ, OFF, PLY, STL, GLB or glTF by the ending of the name; polygons are split into fans of
/// triangles; STL and glTF vertices at equal positions are joined. Text is UTF-8 or, after its
/// byte-order mark, UTF-16.
/// @throws InputError with FILE:LINE where the format has lines, for what is missing, cut short,
///         malformed, not finite or above 1e30, or an index out of range
TriangleMesh read_mesh(const std::filesystem::path& path);

/// Reads a mesh from memory; `name` is what errors call it.
TriangleMesh parse_obj(std::string_view bytes, std::string_view name);
TriangleMesh parse_off(std::string_view bytes, std::string_view name);
TriangleMesh parse_ply(std::string_view bytes, std::string_view name);
TriangleMesh parse_stl(std::string_view bytes, std::string_view name);
/// Reads GLB or glTF text: the triangles of the default scene, transformed by its nodes.
/// @param folder  where external buffers are looked for; none: files that need them are refused
TriangleMesh parse_gltf(std::string_view bytes, std::string_view name,
                        const std::optional<std::filesystem::path>& folder = std::nullopt);

/// Writes OBJ, with texture coordinates where the mesh has some, or PLY (binary, double precision)
/// by the ending of the name. Numbers are written so that reading them back gives the same bits.
/// @throws OutputError; UsageError on another ending
/// @param colours  [V] linear RGB: written as vertex colours (PLY: bytes; OBJ: behind positions),
/// in
///                 display values of sRGB; none when empty
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                std::span<const Vec3f> colours = {});

/// The same files in memory.
std::string obj_text(const TriangleMesh& mesh, std::span<const Vec3f> colours = {});
std::string ply_bytes(const TriangleMesh& mesh, std::span<const Vec3f> colours = {});

}  // namespace weft
