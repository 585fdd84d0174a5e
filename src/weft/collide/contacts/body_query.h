#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "weft/collide/broad_phase/node_levels.h"
#include "weft/collide/moving_surface.h"

namespace weft {

/// The point of a body's surface that is closest to a point.
struct BodyPoint {
  double squared_distance = HUGE_VAL;  ///< [m^2]
  int triangle = -1;                   ///< 2 * cell + half
  std::array<int, 3> samples{};        ///< of its triangle
  std::array<double, 3> weights{};     ///< of the triangle's corners
  Vec3d position;                      ///< [m]
};

/// Closest-point queries on one body, by the mip pyramid of boxes of its image.
class BodyQuery {
 public:
  /// @param grid  kept by reference
  explicit BodyQuery(const SurfaceGrid& grid);
  /// Fits the boxes to the body's positions.
  /// @param positions  [n x n] [m], kept by pointer
  void place(const Planes3& positions, ThreadTeam& team);

  /// The closest point of the body, or nothing where it is not closer than `reach`. Of equally
  /// close points that of the first triangle.
  /// @param hint  a triangle that may be near, for speed: the answer does not depend on it; -1:
  /// none
  [[nodiscard]] std::optional<BodyPoint> closest(Vec3d point, double reach,
                                                 int hint = -1) const noexcept;
  /// Whether a point lies behind the surface at its closest point, by the angle-weighted normal
  /// there [baerentzen05]: exact for closed surfaces.
  [[nodiscard]] bool behind(Vec3d point, const BodyPoint& closest) const noexcept;
  /// Unit normal at a point of the surface: of the face, or the mean of those around its edge or
  /// corner, weighted by their angles there.
  [[nodiscard]] Vec3d normal_at(const BodyPoint& point) const noexcept;
  /// Whether every edge has two triangles, so that the body has an inside.
  [[nodiscard]] bool closed() const { return closed_; }
  /// Triangles (2 * cell + half) around a point, given by its representative sample.
  [[nodiscard]] std::span<const int> triangles_around(int point) const {
    return std::span(incident_).subspan(starts_[point], starts_[point + 1] - starts_[point]);
  }

 private:
  /// Boxes of a node's children side by side: least x, y, z, then largest; a missing child is
  /// infinitely far.
  struct ChildBoxes {
    std::array<std::array<float, 4>, 3> lower, upper;
  };
  void find_incident();
  void pack_row(int level, int row);
  [[nodiscard]] Vec3d position(int sample) const {
    return vec_cast<double>(positions_->at(sample));
  }
  [[nodiscard]] Vec3d face_normal(const std::array<int, 3>& samples) const noexcept;
  struct Search;
  void search(const Node& node, Search& search) const noexcept;
  void try_triangle(int row, int col, int half, Search& search) const noexcept;

  const SurfaceGrid* grid_;
  const Planes3* positions_ = nullptr;
  ExtentLevels boxes_;
  std::vector<std::vector<ChildBoxes>> children_;  // of each level from 1 on [side * side]
  std::vector<int> starts_, incident_;             // triangles (2 * cell + half) around each point
  bool closed_ = false;
};

}  // namespace weft
