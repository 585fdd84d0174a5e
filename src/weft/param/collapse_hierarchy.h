#pragma once

#include <vector>

#include "weft/cut/disk_mesh.h"
#include "weft/mesh/topology.h"

namespace weft {

/// A disk whose interior vertices can be taken away one by one, each by collapsing an edge onto its
/// other end, and brought back in reverse order. Every collapse keeps the link condition, so that
/// the mesh stays a disk, and makes no chord (an interior edge between two border vertices); the
/// border stays as it is.
///
/// A disk without chords can always be taken down to a wheel, all border vertices around one inner
/// vertex: inside an innermost cycle of three edges that is no triangle, or, where there is none,
/// inside the border, the inner vertices hang together, and every edge between two of them can be
/// collapsed; a single one inside three edges can go onto any of them.
///
/// Triangles and half-edges keep their numbers. A triangle that a collapse removes keeps its
/// corners and twins of then, which is all that it takes to bring it back.
class CollapseHierarchy {
 public:
  /// @pre disk without chords (weft/param/chords.h)
  explicit CollapseHierarchy(const DiskMesh& disk);

  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  [[nodiscard]] bool has_triangle(int triangle) const { return present_[triangle]; }
  [[nodiscard]] int triangle_count() const { return triangle_count_; }
  [[nodiscard]] int vertex_count() const { return static_cast<int>(valence_.size()); }
  /// Whether a vertex is there and not on the border.
  [[nodiscard]] bool is_inner(int vertex) const { return inner_[vertex]; }
  /// How many edges a vertex has.
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

  /// Whether the vertex that a half-edge leaves can go onto the one it points at. @pre the first is
  /// inner
  [[nodiscard]] bool can_collapse(int half_edge);
  /// @pre can_collapse
  void collapse(int half_edge);
  /// Takes the last collapse back. @return its half-edge, which leaves the vertex that came back
  int undo();

 private:
  void set_start(int half_edge, int vertex) { triangles_[half_edge / 3][half_edge % 3] = vertex; }
  void join(int half_edge, int other);

  std::vector<Triangle> triangles_;
  std::vector<int> twin_, outgoing_, valence_;
  std::vector<bool> present_, inner_, border_;
  std::vector<int> collapsed_;  ///< half-edges, in order
  std::vector<int> stamp_;      ///< [V] the last round in which a vertex was met
  int round_ = 0;
  int triangle_count_ = 0;
};

/// The disk of the triangles that are left, its vertices in their old order.
struct CoarseDisk {
  DiskMesh disk;
  std::vector<int> vertex;  ///< [D'] of the fine disk
};
CoarseDisk coarse_disk(const CollapseHierarchy& mesh, const DiskMesh& fine);

}  // namespace weft
