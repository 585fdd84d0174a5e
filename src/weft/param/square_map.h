#pragma once

#include <string>
#include <variant>
#include <vector>

#include "weft/core/progress.h"
#include "weft/cut/disk_mesh.h"
#include "weft/param/border_layout.h"

namespace weft {

/// Where each disk vertex lies in the square. Kept in sample units, [0, n - 1]^2, so that samples
/// are whole numbers and exact.
struct SquareMap {
  int size = 0;           ///< n
  std::vector<Vec2d> uv;  ///< [D]
};

/// How well a map treats its surface.
struct MapQuality {
  int flipped = 0;          ///< triangles turned over, by exact arithmetic
  int degenerate = 0;       ///< triangles of no area, by exact arithmetic
  double stretch_l2 = 0;    ///< root of the area-weighted mean square stretch, scaled so that a map
                            ///< that keeps all areas and angles has 1 [sander01]
  double stretch_linf = 0;  ///< largest singular value over all triangles, in the same scale
};
MapQuality measure_map(const DiskMesh& disk, const SquareMap& map);

/// Floater's shape-preserving weights [floater97], nothing more.
struct FloaterOptions {};
/// A map of a coarse version of the disk by symmetric positive weights, reweighted by stretch
/// [yoshizawa04], then Newton steps on the stretch itself; refined to the whole disk.
struct StretchOptions {
  int iterations = 10;    ///< of reweighting, at most; the best iterate is kept
  int newton_steps = 60;  ///< at most; they end when they gain little. 0: reweighting of the whole
                          ///< disk, nothing more
};
using Parameterizer = std::variant<StretchOptions, FloaterOptions>;

struct MapOptions {
  int size = 257;
  Parameterizer parameterizer = StretchOptions{};
  std::string name = "mesh";  ///< what errors call the input
  int rotations = 8;          ///< how many border rotations are tried
  Progress* progress = nullptr;
};

/// A cut disk with its border laid out and its inside mapped.
struct MappedDisk {
  CutDisk cut;  ///< the input, with edges split at corners, sample nodes and chords
  BorderLayout layout;
  SquareMap map;
  MapQuality quality;
  std::string parameterizer;  ///< name as on the command line
};

/// Stages 5 to 8. The result has no flipped and no degenerate triangle.
/// @throws TopologyError when n is too small (naming the least n) or no valid map was found
MappedDisk map_to_square(const CutDisk& cut, const MapOptions& options);

}  // namespace weft
