#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// The faces of a mesh as its author made them: polygons of any number of corners, and texture
/// coordinates with indices of their own.
struct MeshFaces {
  std::vector<int> sizes;              ///< [P] corners of each polygon, >= 3
  std::vector<int> corners;            ///< [sum of sizes] vertices
  std::vector<Vec2f> texture{};        ///< [T] v runs upwards
  std::vector<int> texture_corners{};  ///< [sum of sizes] into texture, -1: none; or empty: no
                                       ///< corner has any
  [[nodiscard]] bool has_texture() const { return !texture_corners.empty(); }
};

/// The triangles of a mesh as faces; equal texture coordinates of one vertex become one.
MeshFaces faces_of(const TriangleMesh& mesh);

/// Every polygon as a fan from its first corner, the order in which readers split them.
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

}  // namespace weft
