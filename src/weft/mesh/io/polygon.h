#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "weft/mesh.h"

namespace weft {

/// Maximum number of triangles and of vertices of a mesh: half-edges are counted in int.
inline constexpr std::int64_t max_elements = 700'000'000;

/// The triangles of a polygon, as places among its corners: the fan from its first corner where
/// that covers it, as of every convex one; else ears are cut off, seen along the mean normal
/// [ericson04, 12.5]. A polygon that crosses itself is a fan.
std::vector<Triangle> split_polygon(std::span<const Vec3d> corners);

/// Appends the triangles of a polygon, a fan where its vertices are not known yet. @return their
/// places where they are no fan, else nothing
std::vector<Triangle> add_polygon(TriangleMesh& mesh, std::span<const int> corners);
/// Appends a polygon with a texture coordinate for each corner. @pre as many of both
std::vector<Triangle> add_polygon(TriangleMesh& mesh, std::span<const int> corners,
                                  std::span<const Vec2f> uv);
/// Appends the triangles of a strip, of which every second one is turned over, so that all face the
/// same side. Degenerate triangles, by which strips jump, are left out but count.
void add_strip(std::vector<Triangle>& triangles, std::span<const int> corners);
/// Drops the texture coordinates unless every corner of the mesh has finite ones.
void keep_whole_texture(TriangleMesh& mesh);

/// What a file of points or of lines is refused with.
inline constexpr std::string_view surface_wanted = "a surface of triangles is wanted";

/// @param lines  whether the file holds lines, which an error about a lack of triangles tells
/// @throws InputError when there is no vertex, no triangle, or too many of either
void require_surface(const TriangleMesh& mesh, std::string_view name, bool lines = false);

/// @throws InputError when a file that should be text holds a zero byte, as binary files do
/// @param format  what is wanted, for example "an OBJ text file"
void require_text(std::string_view bytes, std::string_view name, std::string_view format);

}  // namespace weft
