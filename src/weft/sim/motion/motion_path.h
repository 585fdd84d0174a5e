#pragma once

#include <span>

#include "weft/scene.h"

namespace weft {

/// Where a path stands: linear between its keys, still before the first and after the last.
/// @pre at least one key
MotionKey key_at(std::span<const MotionKey> path, double seconds);

/// The fastest that anything goes that a path turns and moves. [m/s]
/// @param reach  how far from the middle of turning it may be [m]
double fastest_on(std::span<const MotionKey> path, double reach);

}  // namespace weft
