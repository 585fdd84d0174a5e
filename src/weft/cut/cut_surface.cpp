#include "weft/cut/cut_surface.h"

namespace weft {

CutSurface::CutSurface(const TriangleMesh& mesh)
    : mesh_(mesh), edges_(half_edges(vertex_count(), mesh.triangles)), length_(half_edge_count()) {
  for (int h = 0; h < half_edge_count(); ++h)
    length_[h] = weft::length(mesh.positions[from(h)] - mesh.positions[to(h)]);
}

}  // namespace weft
