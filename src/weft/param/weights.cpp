#include "weft/param/weights.h"

#include <algorithm>
#include <cmath>

#include "weft/param/edge_lengths.h"

namespace weft {

std::vector<double> mean_value_weights(const DiskMesh& disk, const HalfEdges& edges,
                                       std::span<const std::array<double, 3>> sides) {
  std::vector<double> weights(3 * disk.triangles.size(), 0.0);
  for (int t = 0; t < static_cast<int>(disk.triangles.size()); ++t) {
    const std::array<double, 3> tangents = half_angle_tangents(sides[t]);
    for (int k = 0; k < 3; ++k) {
      // The angle at corner k lies beside the half-edge that leaves it and, across, beside the twin
      // of the one that arrives.
      weights[3 * t + k] += tangents[k] / sides[t][k];
      const int arriving = (k + 2) % 3;
      const int twin = edges.twin[3 * t + arriving];
      if (twin >= 0) weights[twin] += tangents[k] / sides[t][arriving];
    }
  }
  return weights;
}

std::vector<double> symmetric_weights(const DiskMesh& disk, const HalfEdges& edges,
                                      std::span<const std::array<double, 3>> sides) {
  std::vector<double> weights = mean_value_weights(disk, edges, sides);
  for (int h = 0; h < static_cast<int>(weights.size()); ++h) {
    const int twin = edges.twin[h];
    if (twin > h) weights[h] = weights[twin] = 0.5 * (weights[h] + weights[twin]);
  }
  return weights;
}

}  // namespace weft
