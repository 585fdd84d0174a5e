#pragma once

#include <span>
#include <string>
#include <vector>

#include "weft/mesh.h"

namespace CLI {
class App;
}

namespace weft::app {

/// Unit and up axis of a mesh's file.
struct MeshArgs {
  std::string unit = "m", up = "y";
  std::vector<std::string> given{};  ///< the options that were given
};
void add_mesh_options(CLI::App& command, MeshArgs& args);
MeshFrame frame_of(const MeshArgs& args);
/// @throws UsageError  where the options are given, and all meshes are built-in shapes
void check_frame(const MeshArgs& args, std::span<const std::string> meshes);

/// A mesh in metres with y up, and warnings about it.
struct NamedMesh {
  TriangleMesh mesh;
  std::vector<std::string> warnings;
};
/// @throws as load_mesh
NamedMesh load_named_mesh(const std::string& name, const MeshArgs& args);

}  // namespace weft::app
