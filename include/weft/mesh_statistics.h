#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "weft/mesh.h"

namespace weft {

/// Counts that fix a surface up to deformation.
struct TopologyCounts {
  int vertices = 0;  ///< referenced ones
  int edges = 0;
  int triangles = 0;
  int components = 0;  ///< joined through shared vertices
  int boundaries = 0;  ///< border loops
  int euler = 0;       ///< V - E + F
  int genus = 0;       ///< of all components together: (2 components - boundaries - euler) / 2; -1
                       ///< of what is no oriented manifold
};

/// Counts the topology of a manifold, oriented mesh.
/// @throws TopologyError for any other
TopologyCounts count_topology(int vertex_count, std::span<const Triangle> triangles);
/// For triangles that hang together in any way: edges of more than two triangles count once,
/// borders are the connected parts that edges of one triangle make.
TopologyCounts count_complex(int vertex_count, std::span<const Triangle> triangles);

/// Distances from one surface to another: mean and root mean square over samples of its area, the
/// maximum over these and all its vertices [m].
struct OneSidedDistance {
  double mean = 0, rms = 0, largest = 0;
};

/// A component of a mesh: triangles connected through edges. Vertices count once for each fan of
/// triangles around them, as they would after splitting non-manifold ones.
struct ComponentStatistics {
  int triangles = 0, vertices = 0, edges = 0;
  double area = 0;  ///< [m^2]
  int border_edges = 0, nonmanifold_edges = 0;
  int boundaries = 0;      ///< border loops
  bool orientable = true;  ///< a consistent orientation of its triangles exists
  [[nodiscard]] bool closed() const { return border_edges == 0 && nonmanifold_edges == 0; }
  [[nodiscard]] int euler() const { return vertices - edges + triangles; }
  /// Nothing where the genus has no meaning: not orientable, or not manifold.
  [[nodiscard]] std::optional<int> genus() const {
    if (!orientable || nonmanifold_edges > 0) return std::nullopt;
    return (2 - boundaries - euler()) / 2;
  }
};

/// A connected set of border edges: on a manifold mesh one closed curve.
struct BorderLoopStatistics {
  int edges = 0;      ///< as many as vertices
  double length = 0;  ///< [m]
  int component = 0;
  int min_vertex = 0;
};

/// Measures and defects of any mesh, broken ones too; nothing is repaired. Triangles with a
/// repeated vertex are counted and left out of all else. Lists of vertices and edges hold mesh
/// vertices and are ascending.
struct MeshStatistics {
  int vertices = 0, triangles = 0;

  int unreferenced_vertices = 0;  ///< in no triangle
  int coincident_vertices = 0;    ///< at the position of an earlier one: seams that are not joined
  int not_finite_vertices = 0;    ///< treated as the origin in all that follows
  bool texture_coordinates = false;  ///< every corner of every triangle has them
  Box3d box;                         ///< of the finite vertices
  double area = 0;                   ///< [m^2]
  std::optional<double> volume;  ///< where closed and consistently oriented; < 0: inside out [m^3]

  int repeated_vertex_triangles = 0;
  int duplicate_triangles = 0;  ///< with the vertices of an earlier one
  int zero_area_triangles = 0;  ///< corners on one line, exactly; not counting repeated vertices
  int slivers = 0;         ///< triangles with 4 sqrt(3) area / (sum of squared edges) below 0.01
  double min_quality = 1;  ///< the minimum of that measure: 1 for an equilateral triangle

  int components = 0;
  std::vector<ComponentStatistics> component_list;  ///< largest area first
  std::vector<BorderLoopStatistics> border_loops;   ///< longest first
  int border_edges = 0;                             ///< edges of one triangle
  int nonmanifold_edges = 0;                        ///< edges of more than two
  std::vector<std::array<int, 2>> nonmanifold_edge_list;
  int nonmanifold_vertices = 0;  ///< vertices whose triangles form more than one fan
  std::vector<int> nonmanifold_vertex_list;
  int inconsistent_edges = 0;  ///< edges that both triangles run along in the same direction
  bool orientable = true;      ///< all components are
  bool closed = false;         ///< all components are, and there is one

  std::int64_t self_intersections = 0;  ///< pairs of triangles that cross (weft/mesh/crossings.h)
  int intersecting_triangles = 0;       ///< that are in such a pair
  std::vector<std::array<int, 2>> self_intersection_list;  ///< of triangles, the first 20
};
/// Examines a mesh. @pre indices in range
MeshStatistics examine_mesh(const TriangleMesh& mesh);

/// 4 sqrt(3) area / (sum of squared edge lengths): 1 equilateral, 0 degenerate.
double triangle_quality(Vec3d a, Vec3d b, Vec3d c);

}  // namespace weft
