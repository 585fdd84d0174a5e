#pragma once

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
};
void add_mesh_options(CLI::App& command, MeshArgs& args);
MeshFrame frame_of(const MeshArgs& args);

/// A mesh in metres with y up, and warnings about it.
struct NamedMesh {
  TriangleMesh mesh;
  std::vector<std::string> warnings;
};
/// @throws as load_mesh
NamedMesh load_named_mesh(const std::string& name, const MeshArgs& args);

}  // namespace weft::app
