#pragma once

#include <vector>

#include "weft/cut.h"
#include "weft/cut/disk_mesh.h"
#include "weft/mesh.h"

namespace weft {

class CutGraph;

/// Cut edges of a mesh; opening the mesh along them (its border edges are cut anyway) leaves a
/// disk. Sorted pairs of vertices (a < b), interior edges only, each once, in ascending order.
struct Cut {
  std::vector<std::array<int, 2>> edges;
};

struct CutOptions {
  int seed_triangle =
      -1;  ///< where the removal of phase one begins; -1: try a few, keep the shortest cut
  bool straighten = true;  ///< shorten every path between its nodes
};

/// Stage 3: the edges to open a mesh along [gu02, section 3.1]: removal of triangles in order of
/// geodesic distance from a seed, pruning, then straightening. A closed sphere gets a path between
/// a far pair of vertices; a disk gets no edge.
/// @pre repaired mesh (weft/repair.h). Deterministic.
/// @throws TopologyError when the seed triangle does not exist
Cut open_to_disk(const TriangleMesh& mesh, const CutOptions& options = {});

/// The same for a surface of which some edges are open already; those stay.
/// @pre the open edges leave the surface in one piece
/// @throws TopologyError when the seed triangle does not exist
Cut complete_cut(const CutGraph& held, const CutOptions& options = {});

/// Joins more vertices to a cut by shortest paths, keeping a disk (stage 4). A vertex already on
/// the cut or the border changes nothing.
Cut extend_cut(const TriangleMesh& mesh, const Cut& cut, int vertex);

/// The mesh opened along the cut, its border divided into paths.
/// @throws TopologyError when the opened mesh is not one disk
CutDisk cut_open(const TriangleMesh& mesh, const Cut& cut);

CutSummary summarise(const CutDisk& cut);

}  // namespace weft
