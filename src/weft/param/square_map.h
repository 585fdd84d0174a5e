#pragma once

#include <string>
#include <variant>
#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/param/border_layout.h"
#include "weft/parameterizer.h"
#include "weft/progress.h"

namespace weft {

/// The position of each disk vertex in the square, in sample units, [0, n - 1]^2, so that samples
/// are whole numbers and exact.
struct SquareMap {
  int size = 0;           ///< n
  std::vector<Vec2d> uv;  ///< [D]
};

MapQuality measure_map(const DiskMesh& disk, const SquareMap& map);

struct MapOptions {
  int size = 257;
  Parameterizer parameterizer = StretchOptions{};
  std::string name = "mesh";  ///< name of the input in errors
  int rotations = 8;          ///< number of border rotations tried
  int threads = 1;
  Progress* progress = nullptr;
};

/// A cut disk with its border laid out and its interior mapped.
struct MappedDisk {
  CutDisk cut;  ///< the input, with edges split at corners of the square and at chords
  BorderLayout layout;
  SquareMap map;
  MapQuality quality;
  std::string parameterizer;  ///< name as on the command line
};

/// Stages 5 to 8. The result has no flipped and no degenerate triangle.
/// @throws TopologyError when n is too small (naming the least n) or no valid map was found
MappedDisk map_to_square(CutDisk cut, const MapOptions& options);

/// The border rotation (border position of the first path's first node) of lowest energy among
/// about `count` candidates, spread evenly over one side of the square (rotating by a whole side
/// only rotates the map), and the neighbours of the best at half the spacing. Candidates are
/// evaluated by trial maps (weft/param/trial_map.h), on a coarser mesh where the disk has more than
/// 2000 triangles.
/// @pre n is large enough for the cut
int choose_rotation(const CutDisk& cut, int size, int count, int threads = 1);

}  // namespace weft
