#pragma once

#include <vector>

#include "weft/mesh.h"

namespace weft {

/// The point (1 - fraction) a + fraction b of an edge between two disk vertices.
struct EdgePlace {
  int a = -1, b = -1;  ///< disk vertices; -1 for a vertex that the input has
  double fraction = 0;
};

/// A surface cut open to a disk. A point of the surface on the cut has several disk vertices.
struct DiskMesh {
  std::vector<Vec3d> positions;       ///< [D]
  std::vector<Triangle> triangles;    ///< counter-clockwise in the plane as on the surface
  std::vector<int> surface_vertex;    ///< [D] the point of the surface: shared by mates. Below the
                                      ///< input's vertex count it is an input vertex, from there on
                                      ///< it came from splitting an edge
  std::vector<int> surface_triangle;  ///< [F] the input's triangle that holds each; empty where
                                      ///< the disk was not made by cut_open
  std::vector<EdgePlace> split_from;  ///< [D] where vertices were put that split an edge; a
                                      ///< triangle's corners lie in its surface triangle. May be
                                      ///< shorter: the rest are the input's
  std::vector<int> border;  ///< the disk vertices around, counter-clockwise (surface to the left)
};

/// Appends a vertex that splits an edge.
/// @param position  of the place, the same bits for both mates
/// @return its index
int add_split_vertex(DiskMesh& disk, const EdgePlace& place, Vec3d position, int surface_vertex);

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

/// Inserts a vertex into the border edge that starts at `border_index`, and one at the same place
/// into the edge's mate, where it has one: both are one new surface point with equal bits. Indices
/// into the border and the paths' firsts are renewed; a mate that stands earlier in the border
/// shifts them by one more.
/// @param fraction  where on the edge, in (0, 1) from its start
void split_border_edge(CutDisk& cut, int border_index, double fraction);

/// The path that has the border edge that starts at `border_index`.
int path_of_border_edge(const CutDisk& cut, int border_index);

}  // namespace weft
