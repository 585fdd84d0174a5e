#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "weft/colliders.h"
#include "weft/geometry_image.h"
#include "weft/grid.h"
#include "weft/mesh/crossings.h"

namespace weft {

/// A triangulated grid whose positions are read at every count. Triangles with coinciding corners
/// are degenerate and meet nothing.
struct GridTriangles {
  const Planes3* positions = nullptr;  ///< [n x n] world, mates equal [m]
  /// Corners as samples, mates as one: what has the same two corners is one edge.
  const std::vector<Triangle>* triangles = nullptr;
  /// The classes that samples are being sewn into; null: none. Triangles that are to share a corner
  /// do not count as long as it is not in one place.
  const BorderMates* sewn = nullptr;
  /// Samples of a body that lie in the body itself [n * n]; triangles at them do not count. Null or
  /// empty: none does.
  const std::vector<char>* buried = nullptr;
};

/// Counts the pairs of triangles that cross each other (weft/mesh/crossings.h): exact for the
/// positions as they are. Touching pairs do not count, so that neighbours are no special case;
/// pairs that overlap in one plane do, and one pair for each edge along which surfaces pass exactly
/// through each other. Independent of every collider: none of their code is used
/// here.
class IntersectionCheck {
 public:
  /// Surfaces are kept by reference and read at every count.
  /// @pre finite positions
  /// @param ground  height of the ground, if there is one [m]
  IntersectionCheck(std::span<const GridTriangles> cloths, std::span<const GridTriangles> bodies,
                    std::optional<double> ground);
  /// Counts the intersections of the current positions.
  [[nodiscard]] IntersectionCounts count();
  /// The part of a cloth's triangles that lie exactly on those of another: in one plane,
  /// overlapping. From 0 to 1.
  [[nodiscard]] double part_lying_on(std::size_t cloth, std::size_t other);

 private:
  /// A grid with the tree over its triangles, which is refitted only when a sample has moved.
  class Surface {
   public:
    explicit Surface(const GridTriangles& grid);
    void follow();
    [[nodiscard]] std::int64_t count_self() const;
    [[nodiscard]] const CrossingSurface& crossing() const { return crossing_; }
    [[nodiscard]] std::size_t triangle_count() const { return grid_.triangles->size(); }
    /// @return number of triangles with a corner below `height`
    [[nodiscard]] std::int64_t count_below(double height);
    /// Whether a triangle of a body lies in the body itself.
    [[nodiscard]] bool is_buried(int triangle) const;

   private:
    /// Whether two triangles are neighbours across a seam that is still open between them.
    [[nodiscard]] bool meet_at_open_seam(int s, int t) const;

    GridTriangles grid_;
    std::vector<Vec3f> seen_;  // [n * n] where the samples were when the tree was fitted
    CrossingSurface crossing_;
  };

  std::vector<Surface> cloths_, bodies_;
  std::optional<double> ground_;
};

}  // namespace weft
