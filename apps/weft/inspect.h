#pragma once

#include <string>
#include <vector>

#include "apps/weft/context.h"
#include "apps/weft/mesh_args.h"

namespace weft::app {

struct InspectArgs {
  MeshArgs frame;
  std::string subject, against;
};

/// Prints the statistics of a mesh and whether it converts. @throws as load_mesh
void inspect_mesh(const InspectArgs& args, const Context& context);

/// Prints the panels of a sewing pattern and what they are sewn to. @throws as read_pattern
void inspect_pattern(const InspectArgs& args, const Context& context);

/// Prints the properties of a geometry image, and its distance to the mesh `against`, if there is
/// one.
/// @throws as read_image, load_mesh
void inspect_image(const InspectArgs& args, const Context& context);

}  // namespace weft::app
