#pragma once

#include <string>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/convert.h"
#include "weft/scene.h"

namespace weft {

/// Makes a cloth with the rest shape that its surface and its scene give it: as it is placed, flat
/// panels of a garment, or its texture.
/// @param placed  samples at the start [n x n] [m]
/// @param notes  gets what users should know
/// @throws SceneError  where the surface has no such rest shape
Cloth cloth_of(const SceneCloth& wanted, const Planes3& placed, const LoadedSurface& loaded,
               std::vector<std::string>& notes);

}  // namespace weft
