#include <algorithm>
#include <cmath>

#include "fuzz/mesh_properties.h"
#include "weft/mesh/io/gltf_rig.h"

namespace {

/// Its first animation, if it has one, moves as many vertices as the mesh has, and each somewhere.
void check_motion(std::string_view bytes, std::size_t vertices) {
  const auto rig = weft::fuzz::read_or_refuse(
      [&] { return weft::read_gltf_rig(bytes, weft::fuzz::file_name, "", std::nullopt); });
  if (!rig) return;
  weft::fuzz::require(static_cast<std::size_t>(rig->points()) == vertices,
                      "a motion is that of the mesh's vertices");
  for (const double part : {0.0, 0.3, 1.0}) {
    const auto positions =
        weft::fuzz::read_or_refuse([&] { return weft::positions_at(*rig, part * rig->duration); });
    if (positions) weft::fuzz::require(positions->size() == vertices, "all vertices are placed");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = weft::fuzz::as_text(data, size);
  const auto parse = [](std::string_view text, std::string_view name) {
    return weft::parse_gltf(text, name);
  };
  const auto mesh = weft::fuzz::read_or_refuse([&] { return parse(bytes, weft::fuzz::file_name); });
  if (mesh) check_motion(bytes, mesh->positions.size());
  return weft::fuzz::check_mesh(bytes, parse);
}
