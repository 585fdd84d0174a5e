#include "weft/convert/pieces.h"

#include <numeric>

#include "weft/mesh/surface_parts.h"
#include "weft/mesh/topology.h"

namespace weft {

Piece whole_piece(const TriangleMesh& mesh) {
  Piece piece{mesh, std::vector<int>(mesh.positions.size()),
              std::vector<int>(mesh.triangles.size())};
  std::iota(piece.vertex.begin(), piece.vertex.end(), 0);
  std::iota(piece.triangle.begin(), piece.triangle.end(), 0);
  return piece;
}

std::vector<Piece> pieces_of(const TriangleMesh& mesh) {
  const auto vertices = static_cast<int>(mesh.positions.size());
  const SurfaceParts parts = surface_parts(mesh, edge_uses(vertices, mesh.triangles));
  std::vector<Piece> pieces(static_cast<std::size_t>(parts.count));
  std::vector<int> part_of_vertex(mesh.positions.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    pieces[parts.part_of[t]].triangle.push_back(static_cast<int>(t));
    for (const int v : mesh.triangles[t]) part_of_vertex[v] = parts.part_of[t];
  }
  std::vector<int> number(mesh.positions.size());
  for (int v = 0; v < vertices; ++v) {
    Piece& piece = pieces[part_of_vertex[v]];
    number[v] = static_cast<int>(piece.vertex.size());
    piece.vertex.push_back(v);
    piece.mesh.positions.push_back(mesh.positions[v]);
  }
  for (Piece& piece : pieces)
    for (const int t : piece.triangle) {
      const auto& [a, b, c] = mesh.triangles[t];
      piece.mesh.triangles.push_back({number[a], number[b], number[c]});
      if (!mesh.corner_uv.empty()) piece.mesh.corner_uv.push_back(mesh.corner_uv[t]);
      const Vec3d p = mesh.positions[a];
      piece.area += 0.5 * length(cross(mesh.positions[b] - p, mesh.positions[c] - p));
    }
  return pieces;
}

}  // namespace weft
