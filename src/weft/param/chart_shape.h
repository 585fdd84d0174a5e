#pragma once

#include <limits>

#include "weft/cut/open_to_disk.h"
#include "weft/param/border_layout.h"
#include "weft/progress.h"

namespace weft {

/// The aspect of a chart: its longer over its shorter side, 1 of a square.
/// @param cells     about how many it has; fewer where max_side forbids a chart as long as that
/// @param max_side  samples, of which it has no more along a side
/// @return a square, or a chart that is wider than high; sides are 4 k + 1
ChartSize chart_size(double cells, double aspect, int max_side);

/// The least shorter side of a chart for which a square of so many cells a side is too wide: so
/// that the same coarser levels have samples enough, two where the square has. [cells]
int min_shorter(double side);

/// A shape of a chart, and what its map is worth there.
struct ShapeTrial {
  double aspect = 1;
  /// Of a trial map, times the cells of its chart: the same however finely that is sampled.
  /// Infinite where no trial map is valid.
  double energy = std::numeric_limits<double>::infinity();
};

struct ShapeOptions {
  double cells = 256 * 256;    ///< about how many the chart has
  int proxy_triangles = 1500;  ///< larger meshes are evaluated on a proxy of about this size
  int threads = 1;
  Progress* progress = nullptr;
};

/// What one aspect is worth, in a chart with room for all its cells.
ShapeTrial try_aspect(const CutDisk& cut, double aspect, const ShapeOptions& options);

/// The disk that shapes are tried on. @pre repaired mesh that the cut opens to a disk
CutDisk shape_proxy(const TriangleMesh& mesh, const Cut& cut, const ShapeOptions& options);

/// Of two aspects the one of less energy: that of the rectangle which has the area and the border
/// of the disk, as a strip has, and its root. One that is nearly square is left out; where both
/// are, the energy is infinite.
ShapeTrial best_aspect(const CutDisk& cut, const ShapeOptions& options);

}  // namespace weft
