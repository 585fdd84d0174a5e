#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "weft/mesh.h"

namespace weft {

/// A manifold mesh, closed or with borders, under local edits that preserve its topology.
class EditableMesh {
 public:
  explicit EditableMesh(TriangleMesh mesh);

  [[nodiscard]] int vertex_count() const { return static_cast<int>(positions_.size()); }
  /// Number of triangle slots; some hold no triangle any more.
  [[nodiscard]] int slot_count() const { return static_cast<int>(triangles_.size()); }
  [[nodiscard]] bool is_alive(int slot) const { return triangles_[slot][0] >= 0; }
  [[nodiscard]] const Triangle& triangle(int slot) const { return triangles_[slot]; }
  [[nodiscard]] Vec3d position(int vertex) const { return positions_[vertex]; }
  void move(int vertex, Vec3d to) { positions_[vertex] = to; }
  /// Slots of the triangles around a vertex, none for one that was merged away.
  [[nodiscard]] std::span<const int> around(int vertex) const { return around_[vertex]; }
  /// The one-ring of a vertex, ascending.
  [[nodiscard]] std::vector<int> neighbours(int vertex) const;
  /// The two neighbours of a vertex along its border; none inside.
  [[nodiscard]] std::optional<std::array<int, 2>> border_neighbours(int vertex) const;
  /// How many triangles hold both vertices: 2 inside, 1 on the border, 0 when they are not
  /// neighbours.
  [[nodiscard]] int triangles_at_edge(int a, int b) const;
  /// The normal of a triangle, as long as twice its area.
  [[nodiscard]] Vec3d area_normal(int slot) const;
  [[nodiscard]] double quality(int slot) const;

  /// Puts a vertex on edge (a, b).
  void split(int a, int b, Vec3d at);
  /// True when merging b into a keeps the topology (the link condition).
  [[nodiscard]] bool can_collapse(int a, int b) const;
  /// Merges b into a. @pre can_collapse
  void collapse(int a, int b, Vec3d to);
  /// Flips the edge from a to b if that improves the worse of its two triangles and makes no
  /// crease. @return whether it did
  bool flip_if_better(int a, int b);

  /// The mesh without the unused vertices and slots.
  [[nodiscard]] TriangleMesh compact() const;

 private:
  [[nodiscard]] int slot_with_directed_edge(int a, int b) const;
  [[nodiscard]] int opposite(int slot, int a, int b) const;
  void replace(int slot, const Triangle& by);
  void remove(int slot);
  void add(const Triangle& triangle);
  [[nodiscard]] Vec3d normal_of(const Triangle& t) const;

  std::vector<Vec3d> positions_;
  std::vector<Triangle> triangles_;
  std::vector<std::vector<int>> around_;
};

}  // namespace weft
