#pragma once

#include "weft/mesh.h"
#include "weft/mesh/shapes/field.h"

namespace weft {

struct RemeshOptions {
  Field surface;      ///< the mesh lies on surface = 0
  Field cut;          ///< border vertices lie on cut = 0 too; may be empty for a closed mesh
  Field edge_length;  ///< wanted, by place [m], > 0
  int passes = 8;
};

/// Remeshes a surface with even triangles: splits long edges, merges short ones, flips edges, and
/// relaxes vertices, which are projected to the surface. The topology stays. After Botsch and
/// Kobbelt 2004, with a length that varies over space as in Dunyach et al. 2013; flips depend on
/// triangle quality rather than valence.
TriangleMesh remesh(TriangleMesh mesh, const RemeshOptions& options);

}  // namespace weft
