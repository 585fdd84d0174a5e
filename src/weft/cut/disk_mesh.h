#pragma once

#include <vector>

#include "weft/mesh/triangle_mesh.h"

namespace weft {

/// A surface cut open to a disk. A point of the surface on the cut has several disk vertices.
struct DiskMesh {
  std::vector<Vec3d> positions;     ///< [D]
  std::vector<Triangle> triangles;  ///< counter-clockwise in the plane as on the surface
  std::vector<int> surface_vertex;  ///< [D] the point of the surface: shared by mates. Below the
                                    ///< input's vertex count it is an input vertex, from there on
                                    ///< it came from splitting an edge
  std::vector<int> border;  ///< the disk vertices around, counter-clockwise (surface to the left)
};

/// A run of border edges between two cut nodes, as the border is walked counter-clockwise.
struct BorderPath {
  int first = 0;  ///< index into DiskMesh::border where the run starts (at a node)
  int edges = 0;  ///< how many border edges it has, >= 1; runs wrap around the end of `border`
  int mate =
      -1;  ///< index of the path that is the same curve walked the other way; -1: true border
  int border_loop = -1;  ///< for a true border: which border loop of the surface, counted from 0
};

/// A disk mesh and how its border is divided into paths; the paths cover the border once, in order.
/// A node is a surface point where paths meet: cut valence other than 2, or, on a closed curve
/// without such a point, one chosen vertex; also where true border and cut meet.
struct CutDisk {
  DiskMesh disk;
  std::vector<BorderPath> paths;
};

}  // namespace weft
