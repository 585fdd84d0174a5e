#include <algorithm>

#include "weft/cut/open_to_disk.h"

namespace weft {
namespace {

double path_length(const DiskMesh& disk, const BorderPath& path) {
  const int size = static_cast<int>(disk.border.size());
  double total = 0;
  for (int j = 0; j < path.edges; ++j)
    total += length(disk.positions[disk.border[(path.first + j) % size]] -
                    disk.positions[disk.border[(path.first + j + 1) % size]]);
  return total;
}

}  // namespace

CutSummary summarise(const CutDisk& cut) {
  CutSummary summary;
  std::vector<int> nodes;
  const int count = static_cast<int>(cut.paths.size());
  for (int p = 0; p < count; ++p) {
    const BorderPath& path = cut.paths[p];
    nodes.push_back(cut.disk.surface_vertex[cut.disk.border[path.first]]);
    if (path.mate >= 0 && path.mate < p) continue;
    ++summary.paths;
    if (path.mate >= 0) summary.length += path_length(cut.disk, path);
  }
  std::sort(nodes.begin(), nodes.end());
  summary.nodes = static_cast<int>(std::unique(nodes.begin(), nodes.end()) - nodes.begin());
  return summary;
}

}  // namespace weft
