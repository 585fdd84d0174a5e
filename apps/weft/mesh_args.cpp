#include "apps/weft/mesh_args.h"

#include <algorithm>

#include <CLI/CLI.hpp>

#include "weft/convert.h"
#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/shapes.h"

namespace weft::app {

void add_mesh_options(CLI::App& command, MeshArgs& args) {
  const auto note = [&args](const std::string& option) {
    return [&args, option](const std::string&) { args.given.push_back(option); };
  };
  command.add_option("--unit", args.unit, "What the numbers of the mesh's file are")
      ->check(CLI::IsMember({"m", "cm", "mm", "in"}))
      ->each(note("--unit"))
      ->capture_default_str();
  command.add_option("--up", args.up, "Which axis of the mesh's file points up")
      ->check(CLI::IsMember({"y", "z"}))
      ->each(note("--up"))
      ->capture_default_str();
}

MeshFrame frame_of(const MeshArgs& args) {
  MeshFrame frame;
  frame.z_up = args.up == "z";
  if (const auto unit = find_length_unit(args.unit)) frame.unit = *unit;
  return frame;
}

void check_frame(const MeshArgs& args, std::span<const std::string> meshes) {
  if (!args.given.empty() && std::all_of(meshes.begin(), meshes.end(), is_builtin))
    throw UsageError(args.given.front(), "built-in shapes are in metres with y up", "leave it out");
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
