#include <fmt/format.h>

#include "weft/sim/scene_file/scene_parts.h"

namespace weft {

MeshFrame read_frame(const JsonObject& object) {
  MeshFrame frame;
  const std::string unit = object.text("unit", frame.unit.name);
  const auto found = find_length_unit(unit);
  if (!found)
    object.place().key("unit").fail(fmt::format("'{}'", unit), "m, cm, mm or in is wanted");
  frame.unit = *found;
  const std::string up = object.text("up", frame.up());
  if (up != "y" && up != "z")
    object.place().key("up").fail(fmt::format("'{}'", up), "y or z is wanted");
  frame.z_up = up == "z";
  return frame;
}

}  // namespace weft
