#pragma once

#include <vector>

#include "weft/cut/cut_surface.h"
#include "weft/cut/open_to_disk.h"

namespace weft {

/// The edges along which a surface is open: its border, always, and a changing set of interior
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
  /// How many open edges meet at the vertex, border edges included.
  [[nodiscard]] int valence(int vertex) const { return ends_[vertex].valence; }

  /// From now on the edges that are open stay so: `remove` and `prune` leave them alone.
  void hold() { held_ = open_; }
  [[nodiscard]] bool is_held(int half_edge) const { return held_[half_edge]; }
  /// Opens or closes an interior edge, given by either of its half-edges; no-ops when it is so
  /// already.
  void add(int half_edge) { set(half_edge, true); }
  void remove(int half_edge) { set(half_edge, false); }
  /// Opens every interior edge.
  void add_all();
  /// Closes interior edges that dangle, one after the other, until none is left that is not held.
  void prune();

  /// The first open half-edge met when turning around the start of `half_edge` towards the surface
  /// on its right, `half_edge` itself included; -1 when no edge is open there.
  [[nodiscard]] int first_open(int half_edge) const;
  /// Around the opened surface: the open half-edge that follows an open one (surface to the left).
  [[nodiscard]] int next_open(int half_edge) const {
    return first_open(HalfEdges::next(half_edge));
  }

  /// How many pieces the opened surface has.
  [[nodiscard]] int piece_count() const;
  /// The interior path that runs through an open edge, as half-edges one after the other from node
  /// to node; a node has a valence other than 2, or lies between a held edge and another.
  [[nodiscard]] std::vector<int> path_through(int half_edge) const;
  /// Every interior path once, ordered by its least half-edge.
  [[nodiscard]] std::vector<std::vector<int>> paths() const;
  /// Length of the interior edges [m].
  [[nodiscard]] double length() const;
  [[nodiscard]] Cut cut() const;

 private:
  /// The open edges that end at a vertex.
  struct Ends {
    int valence = 0;
    int mix = 0;  ///< exclusive or of their names: of a single one its name
  };
  void set(int half_edge, bool open);
  void count(int half_edge, int change);
  void extend(std::vector<int>& path) const;

  const CutSurface& surface_;
  std::vector<char> open_;  // [3F]
  std::vector<char> held_;  // [3F] among them those of the border
  std::vector<Ends> ends_;  // [V]
};

}  // namespace weft
