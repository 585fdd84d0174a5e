#pragma once

#include <array>

#include "weft/collide/collider.h"
#include "weft/collide/moving_surface.h"
#include "weft/vec.h"

// Features of cloths, as a search for contacts between layers sees them.
namespace weft {

/// A cell of a surface.
struct SurfaceCell {
  const SurfaceGrid* grid = nullptr;
  int cell = 0, row = 0, col = 0;

  SurfaceCell() = default;
  SurfaceCell(const SurfaceGrid& of, int own_row, int own_col)
      : grid(&of), cell(own_row * of.cells() + own_col), row(own_row), col(own_col) {}
  [[nodiscard]] int sample(int corner) const {
    return (row + corner / 2) * grid->size() + col + corner % 2;
  }
  [[nodiscard]] const CellFeatures& features() const { return grid->features(cell); }
  [[nodiscard]] bool owns(int corner) const { return (features().own_corners >> corner & 1) != 0; }
  [[nodiscard]] bool owns_edge(int number) const {
    return (features().own_edges >> number & 1) != 0;
  }
  [[nodiscard]] std::array<int, 2> edge(int number) const { return grid->edge(cell, number); }
  [[nodiscard]] bool shares_corner(const SurfaceCell& other) const;
  /// Whether a vertex, given twice, or an edge is its own, and its triangle `half` is its first
  /// that has it.
  [[nodiscard]] bool gives(const std::array<int, 2>& feature, int half) const;
};

/// One side of a contact: up to three samples of a cloth with weights that sum to 1.
struct ContactSide {
  const MovingCloth* cloth;
  std::array<int, 3> samples;
  std::array<double, 3> weights;

  [[nodiscard]] Vec3d mean(const Planes3& planes) const;
  [[nodiscard]] Vec3d start() const { return mean(cloth->start); }
  [[nodiscard]] Vec3d displacement() const { return mean(cloth->position) - start(); }
  /// Inverse effective mass of the point. [1/kg]
  [[nodiscard]] double compliance() const;
  /// The vertex, twice, or the edge that its point lies on, or the first edge of its triangle.
  [[nodiscard]] std::array<int, 2> feature() const;
};

/// Distance of two points of one cloth along its grid, in samples: the larger of both axes;
/// infinite between charts.
[[nodiscard]] double samples_between(const SurfaceGrid& grid, const ContactSide& a,
                                     const ContactSide& b);

/// The triangles of a surface that have a vertex or an edge of it, on all sides of its seams.
class FeatureRing {
 public:
  /// @param feature  the samples of an edge, or a vertex twice
  /// @param at  positions [n x n], kept by pointer [m]
  FeatureRing(const SurfaceGrid& grid, const Planes3& at, const std::array<int, 2>& feature)
      : grid_(&grid), at_(&at), feature_(feature) {}

  /// Whether a point lies in the Voronoi region of the feature: none of its triangles has a point
  /// beside the feature that is closer.
  [[nodiscard]] bool is_closest_to(Vec3d point) const;
  /// Whether a direction is within 45 degrees of the normal of one of the triangles, on any side.
  [[nodiscard]] bool faces(Vec3d direction) const;

 private:
  template <class Test>
  [[nodiscard]] bool any(const Test& test) const;
  template <class Test>
  [[nodiscard]] bool any_beside(int sample, const Test& test) const;
  [[nodiscard]] bool has(int sample) const;

  const SurfaceGrid* grid_;
  const Planes3* at_;
  std::array<int, 2> feature_;
};

}  // namespace weft
