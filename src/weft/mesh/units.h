#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// A unit of length as it is called on the command line.
struct LengthUnit {
  std::string_view name;
  double metres = 1;
};
inline constexpr std::array<LengthUnit, 4> length_units{
    {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}}};
/// By its name; nothing for others.
std::optional<LengthUnit> find_length_unit(std::string_view name);

/// What the coordinates of a mesh's file mean.
struct MeshFrame {
  LengthUnit unit = length_units[0];
  bool z_up = false;  ///< z points up, y away from the viewer
  [[nodiscard]] std::string_view up() const { return z_up ? "z" : "y"; }
};

/// The same mesh in metres with y up: (x, y, z) with z up becomes (x, z, -y).
TriangleMesh in_metres_y_up(TriangleMesh mesh, const MeshFrame& frame);

/// The same point in a file of that frame; the inverse, but for rounding.
/// @param point  y up [m]
inline Vec3d in_frame(Vec3d point, const MeshFrame& frame) {
  if (frame.z_up) point = {point.x, -point.z, point.y};
  return {point.x / frame.unit.metres, point.y / frame.unit.metres, point.z / frame.unit.metres};
}
/// And back.
inline Vec3d in_metres_y_up(Vec3d point, const MeshFrame& frame) {
  point = frame.unit.metres * point;
  return frame.z_up ? Vec3d{point.x, point.z, -point.y} : point;
}

/// A sentence on a mesh whose largest side is below 5 cm or above 10 m, which no garment and no
/// body is, with the unit that its numbers are likely in; nothing for others.
/// @param mesh  in metres by the unit `taken`
std::optional<std::string> implausible_size(const TriangleMesh& mesh, const LengthUnit& taken);

}  // namespace weft
