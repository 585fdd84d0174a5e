#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "fuzz/properties.h"
#include "weft/mesh.h"
#include "weft/repair.h"

namespace weft::fuzz {

/// The triangles are those of a mesh: vertices exist, coordinates are finite and not beyond 1e30;
/// texture coordinates are there for every corner or for none.
inline void require_sound(const TriangleMesh& mesh) {
  require(!mesh.triangles.empty(), "a mesh has triangles");
  for (const Vec3d& p : mesh.positions)
    require(std::fabs(p.x) <= 1e30 && std::fabs(p.y) <= 1e30 && std::fabs(p.z) <= 1e30,
            "coordinates are finite");
  const int count = static_cast<int>(mesh.positions.size());
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) require(v >= 0 && v < count, "triangles use existing vertices");
  require(mesh.corner_uv.empty() || mesh.corner_uv.size() == mesh.triangles.size(),
          "texture coordinates are whole");
  for (const auto& corners : mesh.corner_uv)
    for (const Vec2f uv : corners)
      require(std::isfinite(uv.x) && std::isfinite(uv.y), "texture coordinates are finite");
}

inline bool same_bits(const TriangleMesh& a, const TriangleMesh& b) {
  const auto same = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  return a.triangles == b.triangles &&
         std::equal(
             a.positions.begin(), a.positions.end(), b.positions.begin(), b.positions.end(),
             [&](Vec3d p, Vec3d q) { return same(p.x, q.x) && same(p.y, q.y) && same(p.z, q.z); });
}

/// Reads a mesh, and holds what came of it to what readers, writers and the repair promise.
/// @param parse  as parse_obj
template <class Parse>
int check_mesh(std::string_view bytes, const Parse& parse) {
  const auto mesh = read_or_refuse([&] { return parse(bytes, file_name); });
  if (!mesh) return 0;
  require_sound(*mesh);
  require(same_bits(*mesh, parse_obj(obj_text(*mesh), "obj")), "OBJ gives the same mesh back");
  require(same_bits(*mesh, parse_ply(ply_bytes(*mesh), "ply")), "PLY gives the same mesh back");
  const auto repaired = read_or_refuse([&] { return repair_mesh(*mesh, {file_name, {}}); });
  if (repaired) require_sound(repaired->mesh);
  return 0;
}

}  // namespace weft::fuzz
