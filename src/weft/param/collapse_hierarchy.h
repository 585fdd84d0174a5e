#pragma once

#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/mesh/topology.h"

namespace weft {

/// A disk mesh whose interior vertices can be removed one by one by half-edge collapses and
/// restored in reverse order. Every collapse keeps the link condition, so that the mesh stays a
/// disk, and makes no chord (an interior edge between two border vertices); the border does not
/// change.
///
/// A disk without chords can always be reduced to a wheel: one inner vertex joined to all border
/// vertices. Take an innermost cycle of three edges that is no triangle, or the border where there
/// is none. The inner vertices inside it are connected, and every edge between two of them can be
/// collapsed; a single inner vertex in a cycle of three collapses onto any of its corners.
///
/// Triangles and half-edges keep their indices. A triangle removed by a collapse keeps its corners
/// and twins of that moment, which is all that `undo` needs.
class CollapseHierarchy {
 public:
  /// @pre disk without chords (weft/param/chords.h)
  explicit CollapseHierarchy(const DiskMesh& disk);

  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  [[nodiscard]] bool has_triangle(int triangle) const { return present_[triangle]; }
  [[nodiscard]] int triangle_count() const { return triangle_count_; }
  [[nodiscard]] int vertex_count() const { return static_cast<int>(valence_.size()); }
  /// Whether a vertex is present and not on the border.
  [[nodiscard]] bool is_inner(int vertex) const { return inner_[vertex]; }
  /// Number of edges at a vertex.
  [[nodiscard]] int valence(int vertex) const { return valence_[vertex]; }
  [[nodiscard]] int from(int half_edge) const { return from_vertex(triangles_, half_edge); }
  [[nodiscard]] int to(int half_edge) const { return to_vertex(triangles_, half_edge); }
  /// How many collapses can be undone.
  [[nodiscard]] int depth() const { return static_cast<int>(collapsed_.size()); }

  /// Visits the half-edges that leave a vertex, one in each triangle, counter-clockwise.
  template <class Visit>
  void around(int vertex, const Visit& visit) const {
    const int first = outgoing_[vertex];
    int h = first;
    do {
      visit(h);
      h = twin_[HalfEdges::previous(h)];
    } while (h >= 0 && h != first);
  }

  /// Whether a half-edge can be collapsed: its start onto its end. @pre its start is inner
  [[nodiscard]] bool can_collapse(int half_edge);
  /// @pre can_collapse
  void collapse(int half_edge);
  /// Undoes the last collapse. @return its half-edge, which leaves the restored vertex
  int undo();

 private:
  void set_start(int half_edge, int vertex) { triangles_[half_edge / 3][half_edge % 3] = vertex; }
  void join(int half_edge, int other);

  std::vector<Triangle> triangles_;
  std::vector<int> twin_, outgoing_, valence_;
  std::vector<bool> present_, inner_, border_;
  std::vector<int> collapsed_;  ///< half-edges, in order
  std::vector<int> stamp_;      ///< [V] the last round in which a vertex was marked
  int round_ = 0;
  int triangle_count_ = 0;
};

/// The disk mesh of the triangles present, its vertices in their order in the fine disk.
struct CoarseDisk {
  DiskMesh disk;
  std::vector<int> vertex;  ///< [D'] index in the fine disk
};
CoarseDisk coarse_disk(const CollapseHierarchy& mesh, const DiskMesh& fine);

}  // namespace weft
