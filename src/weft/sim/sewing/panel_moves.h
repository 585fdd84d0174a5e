#pragma once

#include <span>
#include <vector>

#include "weft/geometry_image.h"
#include "weft/grid.h"

namespace weft {

/// The outer side of a panel, on the mean. @param placed  samples of all panels [n x n] [m]
Vec3d outer_side(const Chart& panel, const Planes3& placed);
/// The panel of a sample, by its chart; of a hole, that of the sample that it follows.
int panel_of(const BorderMates& mates, int sample);
/// Moves panels as they are. @param shift  of each panel [m]
void move_panels(const BorderMates& mates, const std::vector<Vec3d>& shift, Planes3& placed);

/// The mean of some samples, one at least. @param planes  [n x n], as positions [m]
Vec3d mean_of(const Planes3& planes, std::span<const int> samples);

}  // namespace weft
