#pragma once

#include <span>

#include "weft/cloth/cloth.h"
#include "weft/sim/scene.h"

namespace weft {

/// Pins a cloth where its rest shape is.
/// @throws SceneError when a region holds no sample
void pin_places(Cloth& cloth, std::span<const PinPlace> places);

/// The sample nearest to a point of the square.
int sample_at(int size, Vec2d uv);

}  // namespace weft
