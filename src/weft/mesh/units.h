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

/// What the coordinates of a mesh's file mean.
struct MeshFrame {
  LengthUnit unit = length_units[0];
  bool z_up = false;  ///< z points up, y away from the viewer
};

/// The same mesh in metres with y up: (x, y, z) with z up becomes (x, z, -y).
TriangleMesh in_metres_y_up(TriangleMesh mesh, const MeshFrame& frame);

/// A sentence on a mesh whose largest side is below 5 cm or above 10 m, which no garment and no
/// body is, with the unit that its numbers are likely in; nothing for others.
/// @param mesh  in metres by the unit `taken`
std::optional<std::string> implausible_size(const TriangleMesh& mesh, const LengthUnit& taken);

}  // namespace weft
