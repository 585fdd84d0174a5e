#pragma once

#include "weft/geometry_image.h"
#include "weft/param/square_map.h"
#include "weft/progress.h"

namespace weft {

struct FitOptions {
  int rounds = 2;       ///< diagonals depend on the samples and are chosen again before each round
  int iterations = 24;  ///< iterations of conjugate gradients per round
  /// Weight of a tangential distance relative to a normal one: the map should be kept, but the
  /// visible error is the normal distance between the surfaces.
  double along_surface = 0.1;
  Progress* progress = nullptr;
};
/// Moves the samples of an image so that its triangles approximate the mapped surface in the least
/// squares sense, over area-weighted surface points spread over the square. Plain sampling puts the
/// samples on the surface, and where that is curved all triangles on one side of it. Samples of the
/// true border are fixed; mates are one unknown and stay bit-equal.
/// @param image  sampled from `mapped`
GeometryImage fit_samples(const MappedDisk& mapped, const GeometryImage& image,
                          const FitOptions& options = {});

}  // namespace weft
