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
  double area_ratio = 1;  ///< area of the rebuilt mesh over that of the mesh: folds make it larger
  double reversed_area = 0;  ///< part of the rebuilt area that faces the other way than the mesh
  OneSidedDistance from_mesh, from_image;  ///< what both are made of [m]
};
/// Upper bound of psnr_db and its value for equal surfaces, so that reports hold a finite number.
inline constexpr double best_psnr_db = 300;
struct MeasureOptions {
  int threads = 1;
  std::uint64_t seed = 1;  ///< of the surface samples
  Progress* progress = nullptr;
};
/// Measures distances and topology. @throws TopologyError when the image's samples do not make a
/// manifold
ImageQuality measure_image(const GeometryImage& image, const TriangleMesh& mesh,
                           const MeasureOptions& options = {});
/// The same distances of any two meshes; topology and folds stay as they are in an ImageQuality.
ImageQuality measure_mesh(const TriangleMesh& other, const TriangleMesh& mesh,
                          const MeasureOptions& options = {});
/// Measures the topology alone, which is fast; distances stay 0.
ImageQuality measure_topology(const GeometryImage& image);
/// Measures topology, area_ratio and reversed_area; distances stay 0. @throws as measure_image
ImageQuality measure_folds(const GeometryImage& image, const TriangleMesh& mesh);

/// Statistics of an image from its samples alone, without its source mesh.
struct ImageStatistics {
  Box3d box;                        ///< of the world positions [m]
  int largest_mate_class = 0;       ///< samples of the largest class of mates; 0 without mates
  double stretch_l2 = 0;            ///< of the grid's triangles as a map, scaled as MapQuality is
  double stretch_linf = 0;          ///< the largest
  std::array<int, 2> worst_quad{};  ///< row and column of the quad with stretch_linf
  int folded_quads = 0;             ///< quads whose two triangles face away from each other
  int zero_area_triangles = 0;      ///< triangles of the grid without area, exactly
};
ImageStatistics examine_image(const GeometryImage& image);

}  // namespace weft
