#pragma once

#include "weft/geometry_image.h"
#include "weft/param/square_map.h"
#include "weft/progress.h"

namespace weft {

struct FitOptions {
  int rounds = 2;       ///< diagonals follow the samples, so they are chosen again before each
  int iterations = 24;  ///< of conjugate gradients in each round
  /// How much a distance along the surface counts against one across it: the map should be kept,
  /// but what shows is how far the surfaces are apart.
  double along_surface = 0.1;
  Progress* progress = nullptr;
};
/// Moves the samples of an image so that the triangles between them lie as near as possible to the
/// surface that was mapped, in the least squares over surface points spread over the square and
/// weighed by area; plain sampling puts the samples on the surface and all triangles on one side of
/// it where that is curved. Samples of the true border stay where they are; mates are one unknown
/// and stay bit-equal.
/// @param image  sampled from `mapped`
GeometryImage fit_samples(const MappedDisk& mapped, const GeometryImage& image,
                          const FitOptions& options = {});

}  // namespace weft
