#pragma once

#include <array>
#include <cstdint>

#include "weft/geometry_image.h"
#include "weft/mesh.h"
#include "weft/mesh_statistics.h"
#include "weft/progress.h"

namespace weft {

/// Distances and topology of an image against the mesh it came from.
struct ImageQuality {
  bool mates_bit_equal = false;
  int euler = 0, boundaries = 0;  ///< of the rebuilt mesh
  double psnr_db = 0;             ///< 20 log10(box diagonal / larger one-sided RMS distance)
  double hausdorff_percent = 0;   ///< larger one-sided maximum, in percent of the diagonal
  OneSidedDistance from_mesh, from_image;  ///< what both are made of [m]
};
/// What psnr_db is where the surfaces are equal, so that reports hold a number.
inline constexpr double best_psnr_db = 300;
struct MeasureOptions {
  int threads = 1;
  std::uint64_t seed = 1;  ///< of the surface samples
  Progress* progress = nullptr;
};
/// All of it. @throws TopologyError when the image's samples do not make a manifold
ImageQuality measure_image(const GeometryImage& image, const TriangleMesh& mesh,
                           const MeasureOptions& options = {});
/// Without the distances, which stay 0: fast.
ImageQuality measure_topology(const GeometryImage& image);

/// What the samples of an image tell of it, without the mesh that it came from.
struct ImageStatistics {
  Box3d box;                        ///< of the world positions [m]
  int largest_mate_class = 0;       ///< most samples that are one surface point; 0 without mates
  double stretch_l2 = 0;            ///< of the grid's triangles as a map, scaled as MapQuality is
  double stretch_linf = 0;          ///< the largest
  std::array<int, 2> worst_quad{};  ///< row and column of the quad that has it
  int folded_quads = 0;             ///< whose two triangles face away from each other
  int zero_area_triangles = 0;      ///< [triangles of the grid, exactly]
};
ImageStatistics examine_image(const GeometryImage& image);

}  // namespace weft
