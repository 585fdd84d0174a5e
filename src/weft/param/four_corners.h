#pragma once

#include <array>
#include <optional>

#include "weft/cut/disk_mesh.h"
#include "weft/param/border_layout.h"

namespace weft {

/// Whether the area lies in a plane, but for some degrees.
bool is_flat(const DiskMesh& disk);

/// Where the border of an uncut disk turns by about a right angle, where it does so four times and
/// hardly turns between them, as that of a rectangle, a trapezoid or a sector of a ring does:
/// indices into DiskMesh::border, ascending. Nothing for other disks; where a side is more than 8
/// times as long as the one across; and for strips of more than 12 : 1, curved ones of 2 : 1.
std::optional<std::array<int, 4>> four_corners(const CutDisk& cut);

/// The disk whose border is parted there, with the intervals that put its corners at those of the
/// chart, the longer sides along the longer ones, once it is laid out with rotation 0. The first
/// corner is that of the least vertex, or the next one.
CutDisk parted_at(const std::array<int, 4>& corners, CutDisk cut, ChartSize size);

}  // namespace weft
