#include "apps/weft/mesh_args.h"

#include <CLI/CLI.hpp>

#include "weft/convert.h"
#include "weft/mesh.h"
#include "weft/shapes.h"

namespace weft::app {

void add_mesh_options(CLI::App& command, MeshArgs& args) {
  command.add_option("--unit", args.unit, "What the numbers of the mesh's file are")
      ->check(CLI::IsMember({"m", "cm", "mm", "in"}))
      ->capture_default_str();
  command.add_option("--up", args.up, "Which axis of the mesh's file points up")
      ->check(CLI::IsMember({"y", "z"}))
      ->capture_default_str();
}

MeshFrame frame_of(const MeshArgs& args) {
  MeshFrame frame;
  frame.z_up = args.up == "z";
  if (const auto unit = find_length_unit(args.unit)) frame.unit = *unit;
  return frame;
}

NamedMesh load_named_mesh(const std::string& name, const MeshArgs& args) {
  if (is_builtin(name)) return {load_mesh(name), {}};
  const MeshFrame frame = frame_of(args);
  NamedMesh named{in_metres_y_up(load_mesh(name), frame), {}};
  if (const auto warning = implausible_size(named.mesh, frame.unit))
    named.warnings.push_back(name + ": " + *warning);
  return named;
}

}  // namespace weft::app
