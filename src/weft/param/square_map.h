#pragma once

#include <string>
#include <variant>
#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/param/border_layout.h"
#include "weft/parameterizer.h"
#include "weft/progress.h"

namespace weft {

/// The position of each disk vertex in the chart, in sample units, [0, cols - 1] x [0, rows - 1],
/// so that samples are whole numbers and exact.
struct SquareMap {
  ChartSize size;
  std::vector<Vec2d> uv;  ///< [D]
  /// [rows * cols] where the chart's samples lie, those of its border at their whole numbers;
  /// empty: all do.
  std::vector<Vec2d> sample_places{};
};

MapQuality measure_map(const DiskMesh& disk, const SquareMap& map);

struct MapOptions {
  ChartSize size = 257;
  Parameterizer parameterizer = StretchOptions{};
  std::string name = "mesh";  ///< name of the input in errors
  int rotations = 8;          ///< number of border rotations tried
  int rotation_unit = 1;      ///< see RotationOptions
  int threads = 1;
  Progress* progress = nullptr;
};

/// A cut disk with its border laid out and its interior mapped.
struct MappedDisk {
  CutDisk cut;  ///< the input, with edges split at corners of the chart and at chords
  BorderLayout layout;
  SquareMap map;
  MapQuality quality;
  std::string parameterizer;  ///< name as on the command line
};

/// Stages 5 to 8. The result has no flipped and no degenerate triangle.
/// @throws TopologyError when the chart is too small (naming the least square) or no valid map was
/// found
MappedDisk map_to_square(CutDisk cut, const MapOptions& options);

}  // namespace weft
