#pragma once

#include <vector>

#include "weft/mesh.h"

namespace weft {

/// A connected part of a mesh as a mesh of its own.
struct Piece {
  TriangleMesh mesh;
  std::vector<int> vertex;    ///< [V] of each vertex its number in the whole mesh, ascending
  std::vector<int> triangle;  ///< [F] the same of triangles, ascending; corners keep their order
  double area = 0;
};

/// A mesh that is one piece.
Piece whole_piece(const TriangleMesh& mesh);

/// The connected parts of a mesh, the largest area first. @pre manifold edges, every vertex used
std::vector<Piece> pieces_of(const TriangleMesh& mesh);

}  // namespace weft
