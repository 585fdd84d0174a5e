#pragma once

#include <vector>

#include "weft/mesh.h"

namespace weft {

/// The point (1 - fraction) a + fraction b of an edge between two disk vertices.
struct EdgePlace {
  int a = -1, b = -1;  ///< ends of the split edge, disk vertices; -1: not a split vertex
  double fraction = 0;
};

/// A surface cut open to a disk. A point of the surface on the cut has several disk vertices.
struct DiskMesh {
  std::vector<Vec3d> positions;       ///< [D]
  std::vector<Triangle> triangles;    ///< counter-clockwise in the plane as on the surface
  std::vector<int> surface_vertex;    ///< [D] the surface point, shared by mates: below the
                                      ///< input's vertex count an input vertex, from there on a
                                      ///< split vertex
  std::vector<int> surface_triangle;  ///< [F] the input's triangle that contains each; empty where
                                      ///< the disk was not made by cut_open
  std::vector<EdgePlace> split_from;  ///< [D] the split that made each vertex; a triangle's corners
                                      ///< lie in its surface triangle. May be shorter: the rest are
                                      ///< input vertices
  std::vector<int> border;            ///< border vertices, counter-clockwise (surface to the left)
};

/// Appends a vertex that splits an edge, without changing any triangle.
/// @param position  of the new vertex, the same bits for both mates
/// @return its index
int add_split_vertex(DiskMesh& disk, const EdgePlace& place, Vec3d position, int surface_vertex);

/// A run of border edges between two nodes, in counter-clockwise border order.
struct BorderPath {
  int first = 0;  ///< index into DiskMesh::border of its first node
  int edges = 0;  ///< number of border edges, >= 1; a run may wrap around the end of `border`
  int mate =
      -1;  ///< index of the path along the same curve in the opposite direction; -1: true border
  int curve = -1;        ///< of a true border: the curve that it shares with others, -1: none
  bool forward = true;   ///< whether the path runs along that curve's own direction
  int intervals = 0;     ///< the number of sample intervals that it has to have; 0: free
  int border_loop = -1;  ///< for a true border: which border loop of the surface, counted from 0
};

/// A disk mesh with its border divided into paths, which cover the border once, in order. A node is
/// a surface point where paths meet: cut valence other than 2, or, on a closed curve without such a
/// point, one chosen vertex; also where true border and cut meet.
struct CutDisk {
  DiskMesh disk;
  std::vector<BorderPath> paths;
};

/// Splits the border edge that starts at `border_index`, and its mate, if any, at the same place:
/// both new vertices are one new surface point with equal bits. Updates the border and the paths;
/// border indices after a split edge grow by one.
/// @param fraction  where on the edge, in (0, 1) from its start
void split_border_edge(CutDisk& cut, int border_index, double fraction);

/// Index of the path that contains the border edge starting at `border_index`.
int path_of_border_edge(const CutDisk& cut, int border_index);

}  // namespace weft
