#include <algorithm>

#include <fmt/format.h>

#include "weft/mesh.h"

namespace weft {

TriangleMesh in_metres_y_up(TriangleMesh mesh, const MeshFrame& frame) {
  for (Vec3d& p : mesh.positions) p = in_metres_y_up(p, frame);
  return mesh;
}

std::optional<LengthUnit> find_length_unit(std::string_view name) {
  for (const LengthUnit& unit : length_units)
    if (unit.name == name) return unit;
  return std::nullopt;
}

std::optional<std::string> implausible_size(const TriangleMesh& mesh, const LengthUnit& taken) {
  constexpr double least = 0.05, largest = 10;
  // The range of most garments and bodies: a wider one would make the guess of the unit useless.
  constexpr double likely_least = 0.3, likely_largest = 3;
  Box3d box;
  for (const Vec3d p : mesh.positions) box.add(p);
  const Vec3d extent = box.extent();
  const double side = std::max({extent.x, extent.y, extent.z});
  if (!(side > 0) || (side >= least && side <= largest)) return std::nullopt;
  const double in_file = side / taken.metres;
  const auto* const likely =
      std::find_if(length_units.begin(), length_units.end(), [&](const LengthUnit& unit) {
        return in_file * unit.metres >= likely_least && in_file * unit.metres <= likely_largest;
      });
  return fmt::format(
      "its largest side is {:.3g} m, which is {} for a garment or a body; {}", side,
      side < least ? "small" : "large",
      likely != length_units.end()
          ? fmt::format("--unit {} would make it {:.3g} m", likely->name, in_file * likely->metres)
          : "--unit m|cm|mm|in says what its numbers mean");
}

}  // namespace weft
