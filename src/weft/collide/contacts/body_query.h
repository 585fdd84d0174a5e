#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "weft/collide/kernels/body_kernels.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/thread_team.h"

namespace weft {

/// The point of a body's surface that is closest to a point.
struct BodyPoint {
  double squared_distance = HUGE_VAL;  ///< [m^2]
  int triangle = -1;                   ///< 2 * cell + half
  std::array<int, 3> samples{};        ///< of its triangle
  std::array<double, 3> weights{};     ///< of the triangle's corners
  Vec3d position;                      ///< [m]
};

/// Searches for the closest points of several points that lie next to each other.
struct NearestTile {
  static constexpr int capacity = NearTile::capacity;
  int count = 0;
  std::array<Vec3f, capacity> at;      ///< [m]
  std::array<double, capacity> reach;  ///< nothing beyond is found [m]
  std::array<int, capacity> hint;      ///< triangles that may be near, see closest()
  double beyond = 0;                   ///< how much farther others are told from the closest [m]
  void add(Vec3f point, double within, int triangle) {
    at[count] = point;
    reach[count] = within;
    hint[count++] = triangle;
  }
};
/// What it finds of a point.
struct NearestPoint {
  BodyPoint point;    ///< with no triangle where nothing is within reach
  double others = 0;  ///< a lower bound of the distance of all other triangles [m]
};
using NearestPoints = std::array<NearestPoint, NearestTile::capacity>;

/// Closest-point queries on one body, by a tree of boxes over its image.
class BodyQuery {
 public:
  /// @param grid  kept by reference, of 3 x 3 samples or more
  explicit BodyQuery(const SurfaceGrid& grid);
  BodyQuery(const BodyQuery&) = delete;
  BodyQuery& operator=(const BodyQuery&) = delete;
  ~BodyQuery() = default;
  /// Fits the boxes to the body's positions.
  /// @param positions  [n x n] [m], kept by pointer
  void place(const Planes3& positions, ThreadTeam& team);
  /// Takes the same positions from somewhere else.
  void follow(const Planes3& positions);

  /// The closest point of the body, or nothing where it is not closer than `reach`. Of equally
  /// close points that of the first triangle.
  /// @param hint  a triangle that may be near, for speed: the answer does not depend on it; -1:
  /// none
  [[nodiscard]] std::optional<BodyPoint> closest(Vec3d point, double reach,
                                                 int hint = -1) const noexcept;
  /// The same for several points at once, several times as fast.
  void closest(const NearestTile& tile, NearestPoints& found) const noexcept;
  /// The closest point of one triangle.
  [[nodiscard]] BodyPoint point_of(Vec3d point, int triangle) const noexcept;
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
  void begin(Vec3d point, double reach, int hint, NearestPoint& closest) const noexcept;
  void search_one(Vec3d point, NearestPoint& closest) const noexcept;
  void refine(const NearestTile& tile, Range points, NearestPoints& closest) const noexcept;
  void add_all(Vec3d point, NearestPoint& closest) const noexcept;
  void find_incident();
  void find_leaves();
  void fit_leaf_row(int row, std::span<float> extents);
  void fit_level(int level);
  [[nodiscard]] Vec3d position(int sample) const {
    return vec_cast<double>(positions_->at(sample));
  }
  [[nodiscard]] Vec3d face_normal(const std::array<int, 3>& samples) const noexcept;

  const SurfaceGrid* grid_;
  const Planes3* positions_ = nullptr;
  const BodyKernels* kernels_ = nullptr;
  std::vector<BodyLeaf> leaves_;
  std::vector<std::vector<BodyNode>> nodes_;  // of each level [side * side]
  BodyTree tree_;
  std::vector<float> extents_;          // scratch of each leaf row
  std::vector<int> starts_, incident_;  // triangles (2 * cell + half) around each point
  bool closed_ = false;
};

}  // namespace weft
