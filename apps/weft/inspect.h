#pragma once

#include <string>

#include "apps/weft/context.h"
#include "apps/weft/mesh_args.h"

namespace weft::app {

struct InspectArgs {
  MeshArgs frame;
  std::string subject, against;
};

/// Prints what decides a mesh's fate, and that fate. @throws as load_mesh
void inspect_mesh(const InspectArgs& args, const Context& context);

/// Prints what a geometry image is, and how far it is from the mesh `against`, if there is one.
/// @throws as read_image, load_mesh
void inspect_image(const InspectArgs& args, const Context& context);

}  // namespace weft::app
