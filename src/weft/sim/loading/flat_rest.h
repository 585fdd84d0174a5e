#pragma once

#include "weft/convert.h"
#include "weft/scene.h"
#include "weft/sim/placement.h"

namespace weft {

/// A rest shape of islands that lie flat, far from each other.
struct FlatRest {
  Planes3 rest;      ///< [n x n] x along u, y along v [m]
  Planes3 warp;      ///< [n x n] along u
  BorderMates bent;  ///< mates at which an island is one with itself
  double scale = 0;  ///< [m] a unit of the texture
};

/// The texture coordinates of a surface as its rest shape, islands beside each other. Islands that
/// are turned over keep their lengths, and so are as good.
/// @param loaded  of a mesh, one chart for each island, with its texture and source
/// @throws SceneError where triangles have no area in the texture
FlatRest flat_rest(const LoadedSurface& loaded, const PlacementMap& placement,
                   const TextureRest& wanted);

/// The same warp everywhere. [n x n]
Planes3 even_warp(int size, Vec3f direction);

}  // namespace weft
