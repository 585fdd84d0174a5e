#include "weft/cut/disk_mesh.h"

namespace weft {

int add_split_vertex(DiskMesh& disk, const EdgePlace& place, Vec3d position, int surface_vertex) {
  const auto vertex = static_cast<int>(disk.positions.size());
  disk.split_from.resize(disk.positions.size());
  disk.split_from.push_back(place);
  disk.positions.push_back(position);
  disk.surface_vertex.push_back(surface_vertex);
  return vertex;
}

}  // namespace weft
