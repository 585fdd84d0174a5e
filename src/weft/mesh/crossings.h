#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "weft/mesh/box_tree.h"

namespace weft {

/// True when the insides of two triangles (without their edges and corners) have a point in common:
/// one passes through the other, or both lie in one plane and overlap. Touching at a corner or
/// along an edge does not count, so triangles that share corners or an edge need no special case; a
/// triangle without area has no inside. Exact for the doubles as they are. The order of tests for
/// planes that differ is that of [guigue03], with open intervals.
bool triangles_cross(const Corners& a, const Corners& b);

/// True when the three corners are exactly on one line.
bool has_no_area(const Corners& triangle);

/// Which triangles of a surface are neighbours. Surfaces can pass through each other exactly along
/// their edges, where no two triangles cross: an edge between two neighbours lies in a triangle of
/// the other surface, or on an edge between two others, and these are on both sides of it. Who
/// knows neighbours counts that as one pair, of the lesser triangles at those edges.
class Neighbours {
 public:
  Neighbours() = default;  ///< none are known
  /// @param triangles  [F] by vertices >= 0; what has the same two vertices is one edge
  explicit Neighbours(std::span<const Triangle> triangles);
  /// The triangle at the other side of edge k, from corner k to the next; -1: none is known, or the
  /// edge has more than two.
  [[nodiscard]] int across(int triangle, int k) const {
    return across_.empty() ? -1 : across_[static_cast<std::size_t>(triangle)][k];
  }

 private:
  std::vector<std::array<int, 3>> across_;
};

/// Calls visit(s, t) for each pair of triangles of one surface that cross, s < t, in an order that
/// depends on the surface alone. Found through a tree of boxes. @pre finite corners
void for_self_crossings(std::span<const Corners> surface, const Neighbours& neighbours,
                        const std::function<void(int s, int t)>& visit);

/// A moving surface with a tree of boxes: its hierarchy stays, its boxes are refitted.
class CrossingSurface {
 public:
  /// @pre finite corners, here and below
  explicit CrossingSurface(std::vector<Corners> triangles, Neighbours neighbours = {});
  /// The triangles for writing new corners into, [F]; `moved` must follow.
  [[nodiscard]] std::span<Corners> triangles() { return triangles_; }
  void moved() noexcept { tree_.fit_boxes(triangles_); }

  /// How many pairs of its triangles cross.
  [[nodiscard]] std::int64_t count_self_crossings() const;
  /// The same without the pairs that are `left_out`(s, t).
  [[nodiscard]] std::int64_t count_self_crossings(
      const std::function<bool(int s, int t)>& left_out) const;
  /// How many pairs of triangles, one of each surface, cross.
  [[nodiscard]] std::int64_t count_crossings(const CrossingSurface& other) const;
  /// The same without triangles t of the other that are `left_out`(t).
  [[nodiscard]] std::int64_t count_crossings(const CrossingSurface& other,
                                             const std::function<bool(int t)>& left_out) const;
  /// How many of its triangles lie exactly on triangles of the other: in one plane, overlapping.
  [[nodiscard]] int count_lying_on(const CrossingSurface& other) const;

 private:
  std::vector<Corners> triangles_;
  Neighbours neighbours_;
  BoxTree tree_;
};

}  // namespace weft
