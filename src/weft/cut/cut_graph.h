#pragma once

#include <vector>

#include "weft/cut/cut_surface.h"
#include "weft/cut/open_to_disk.h"

namespace weft {

/// The edges along which a surface is cut open: its border edges and a changing set of interior
/// edges. Keeps a reference to the surface, which must outlive it.
class CutGraph {
 public:
  /// Begins with the border alone.
  explicit CutGraph(const CutSurface& surface);
  /// The border and the edges of `cut`. @throws TopologyError naming an edge that the mesh does not
  /// have
  CutGraph(const CutSurface& surface, const Cut& cut);

  [[nodiscard]] const CutSurface& surface() const { return surface_; }
  [[nodiscard]] bool contains(int half_edge) const { return open_[half_edge]; }
  /// Number of open edges at the vertex, border edges included.
  [[nodiscard]] int valence(int vertex) const { return ends_[vertex].valence; }

  /// Holds all edges that are open now: `remove` and `prune` no longer close them.
  void hold() { held_ = open_; }
  [[nodiscard]] bool is_held(int half_edge) const { return held_[half_edge]; }
  /// Opens or closes an interior edge, given by either of its half-edges. No effect when the edge
  /// is in that state already, is held or is a border edge.
  void add(int half_edge) { set(half_edge, true); }
  void remove(int half_edge) { set(half_edge, false); }
  /// Opens every interior edge.
  void add_all();
  /// Closes dangling interior edges (an end of valence 1) until none is left that is not held.
  void prune();

  /// The first open half-edge in clockwise order around the start of `half_edge`, `half_edge`
  /// itself included; -1 when no edge is open there.
  [[nodiscard]] int first_open(int half_edge) const;
  /// Successor of an open half-edge along the border of the opened surface (surface to the left).
  [[nodiscard]] int next_open(int half_edge) const {
    return first_open(HalfEdges::next(half_edge));
  }

  /// Number of connected components of the opened surface.
  [[nodiscard]] int piece_count() const;
  /// The interior path through an open edge, as consecutive half-edges from node to node. A node
  /// has a valence other than 2, or lies between a held edge and one that is not held.
  [[nodiscard]] std::vector<int> path_through(int half_edge) const;
  /// Every interior path once, ordered by the lowest half-edge of each.
  [[nodiscard]] std::vector<std::vector<int>> paths() const;
  /// Length of the interior edges [m].
  [[nodiscard]] double length() const;
  [[nodiscard]] Cut cut() const;

 private:
  /// The open edges that end at a vertex.
  struct Ends {
    int valence = 0;
    int mix = 0;  ///< XOR of their edge names; the name of the edge when there is only one
  };
  void set(int half_edge, bool open);
  void count(int half_edge, int change);
  void extend(std::vector<int>& path) const;

  const CutSurface& surface_;
  std::vector<char> open_;  // [3F]
  std::vector<char> held_;  // [3F] border edges included
  std::vector<Ends> ends_;  // [V]
};

}  // namespace weft
