#pragma once

#include <vector>

#include "weft/cut.h"
#include "weft/cut/disk_mesh.h"
#include "weft/mesh.h"

namespace weft {

class CutGraph;
class CutSurface;

/// Cut edges of a mesh: opened along them and along its border edges, the mesh is a disk. Sorted
/// pairs of vertices (a < b), interior edges only, each once, in ascending order.
struct Cut {
  std::vector<std::array<int, 2>> edges;
};

/// Parts of a mesh's border that belong to curves which several borders share.
struct FixedBorder {
  struct Edge {
    int from = 0, to = 0;  ///< vertices of the mesh, as its border runs
    int curve = -1;
    bool forward = true;  ///< whether the border runs along the curve's own direction
    friend auto operator<=>(const Edge&, const Edge&) = default;
  };
  std::vector<Edge> edges;     ///< ascending
  std::vector<int> nodes;      ///< ascending: where curves end; paths of the border begin there
  std::vector<int> intervals;  ///< [curves] sample intervals that each has to have; empty: free
  [[nodiscard]] bool empty() const { return edges.empty(); }
};

struct CutOptions {
  int seed_triangle = -1;  ///< start of the triangle removal; -1: try a few, keep the shortest cut
  bool straighten = true;  ///< shorten every path of the cut
};

/// Stage 3: the cut that opens a mesh to a disk [gu02, section 3.1], by removal of triangles in
/// order of geodesic distance from a seed, pruning, then straightening. The cut of a closed sphere
/// is a path between two vertices far apart; a disk has an empty cut.
/// @pre repaired mesh (weft/repair.h). Deterministic.
/// @throws TopologyError when the seed triangle does not exist
Cut open_to_disk(const TriangleMesh& mesh, const CutOptions& options = {});
/// The same of a surface that is cut more than once: its half-edges take time on large meshes.
Cut open_to_disk(const CutSurface& surface, const CutOptions& options = {});

/// Completes the open edges of a surface to a cut that opens it to a disk, as open_to_disk. The
/// edges already open stay open.
/// @pre the open edges leave the surface in one piece
/// @throws TopologyError when the seed triangle does not exist
Cut complete_cut(const CutGraph& held, const CutOptions& options = {});

/// Extends a cut by the shortest path from a vertex to it; the opened mesh stays a disk (stage 4).
/// A vertex already on the cut or the border changes nothing.
Cut extend_cut(const TriangleMesh& mesh, const Cut& cut, int vertex);
Cut extend_cut(const CutSurface& surface, const Cut& cut, int vertex);

/// The mesh opened along the cut, its border divided into paths.
/// @throws TopologyError when the opened mesh is not one disk
/// @param fixed  curves along its border, which become paths of their own
CutDisk cut_open(const TriangleMesh& mesh, const Cut& cut, const FixedBorder& fixed = {});
CutDisk cut_open(const CutSurface& surface, const Cut& cut, const FixedBorder& fixed = {});

CutSummary summarise(const CutDisk& cut);

/// Cut by phases one and two of [gu02, section 3.1]: triangles are removed one after the other,
/// starting at a seed, each across the open edge nearest to the seed; then dangling edges are
/// pruned.
///
/// The distance of an edge is the mean of its ends' geodesic distances along edges from the seed's
/// corners. Removing a triangle across its nearest free edge grows a tree in the dual graph. Phase
/// one leaves the edges that the tree does not cross, so a priority queue gives the same result in
/// O(n log n). As the removed triangles form one open disk, the remaining edges are connected and
/// contain every border loop.
/// @param held  edges that stay open whatever the seed; they leave the surface in one piece
CutGraph cut_from_seed(const CutGraph& held, int seed_triangle);

/// Triangles far from each other, the first of them `first`: each further one touches the vertex
/// farthest from those before it. At most `count`, fewer on a tiny mesh.
std::vector<int> spread_triangles(const CutSurface& surface, int first, int count);

}  // namespace weft
