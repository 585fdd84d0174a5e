#pragma once

#include <span>
#include <vector>

#include "weft/convert/pieces.h"
#include "weft/cut/open_to_disk.h"
#include "weft/repair.h"

namespace weft {

/// The curves along which a surface was parted (RepairedMesh::joined): maximal runs of parted edges
/// that every border beside them follows from end to end.
struct SeamCurves {
  std::vector<double> length;        ///< of each curve [m]
  std::vector<FixedBorder> borders;  ///< of each piece, without intervals
};
/// @param pieces  of `input.mesh`
/// @param cuts    of each piece; where a cut meets the border, curves end
SeamCurves find_seam_curves(const RepairedMesh& input, std::span<const Piece> pieces,
                            std::span<const Cut> cuts);

}  // namespace weft
