#pragma once

#include <string>
#include <vector>

#include "weft/mesh.h"
#include "weft/mesh_statistics.h"

namespace weft {

/// Which of several components to keep.
struct ComponentChoice {
  enum class Kind { only, largest, index, all };
  Kind kind = Kind::only;  ///< `only`: more than one is an error; `all`: each becomes a chart
  int index = 0;           ///< for Kind::index, largest area first
};

/// Where else a surface is parted into charts than where it must be.
struct PartChoice {
  bool at_texture_seams = false;
  int regions = 0;  ///< compact ones, as many in all where the surface has fewer parts; 0: none
  /// [triangles of the mesh as it is repaired without regions] which of them lie in parts that
  /// may be divided into regions; empty: all
  std::vector<bool> divisible{};
};

struct RepairOptions {
  std::string name = "mesh";  ///< what errors call the mesh, mostly its path
  ComponentChoice component;
  PartChoice part{};
};

/// A mesh fit for the stages that follow: finite, indexed, manifold, consistently oriented, one
/// component or all, no unreferenced vertex, no triangle with a repeated vertex.
struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<int> source_vertex;    ///< [V] the input's vertex for each of the mesh's
  std::vector<int> source_triangle;  ///< [F] the input's triangle; its orientation may differ
  std::vector<std::string> repairs;  ///< one sentence for each kind of change, with its count
  TopologyCounts counts;             ///< of `mesh`, parted vertices joined
  /// [V] where the surface was parted, at edges of more than two triangles, where it cannot be
  /// oriented, and as PartChoice asks: vertices of the same number are one point of it. Empty
  /// elsewhere.
  std::vector<int> joined;
  /// [vertices of the input] the first vertex at the position of each, where welding them closed
  /// borders; empty elsewhere. Of these only first ones are in `source_vertex`.
  std::vector<int> welded;
  int components_found = 1;  ///< before one was chosen
};

/// Stage 1 of the conversion: checks, and repairs what can be repaired without changing the
/// surface. Drops triangles with a repeated index and unreferenced vertices, orients consistently
/// (breadth first), splits non-manifold vertices into fans, and picks the component. Of all
/// components those without any area are dropped.
/// Where all components are wanted, those without area are dropped, and vertices at exactly equal
/// positions are welded first, if that closes borders and makes no more edges of more than two
/// triangles.
/// @throws InputError     empty mesh, not-finite coordinates, index out of range, no area at all
/// @throws TopologyError  non-manifold edges (count, the first one's vertices), a component that
///                        cannot be oriented (an edge named), several components (how many)
RepairedMesh repair_mesh(const TriangleMesh& mesh, const RepairOptions& options);

/// How many components a mesh has to choose from, whether they convert or not.
/// @throws InputError as repair_mesh
int count_components(const TriangleMesh& mesh, const std::string& name);

/// Joins vertices at exactly equal positions; for formats without indices.
/// @return the joined mesh; vertices in order of first occurrence
TriangleMesh weld_exact(const TriangleMesh& mesh);

}  // namespace weft
