#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/grid.h"
#include "weft/mesh.h"
#include "weft/vec.h"

namespace weft {

/// A perspective camera.
struct Camera {
  Vec3d eye{0, 1, 3}, target{0, 0, 0}, up{0, 1, 0};
  double vertical_angle = 0.6;  ///< field of view [rad]
};

/// The nearest camera that sees the whole box from a given direction: the corners touch a frame a
/// little inside the picture. An empty or not-finite box counts as the unit cube around the origin.
/// @param azimuth, elevation  of the eye seen from the box [rad]; azimuth 0 looks from +z
/// @param aspect              width / height
Camera frame_box(const Box3d& box, double azimuth, double elevation, double aspect);

/// The nearest camera that sees all points, framed as by frame_box. Without points: the unit cube.
/// @pre points are finite
Camera frame_points(std::span<const Vec3d> points, double azimuth, double elevation, double aspect);

/// Free margin that frame_box leaves on the tight sides, as a share of half the picture.
inline constexpr double frame_margin = 0.06;

/// The box of the finite samples; empty when there is none.
Box3d bounds(const Planes3& positions);

/// The extreme points of a point set along 134 fixed directions: a small set that stands for all
/// points when a camera is framed. No point lies more than 2 percent of the set's size beyond them.
class Outline {
 public:
  Outline();
  /// No-op for a point that is not finite.
  void add(Vec3d point);
  void add(const Planes3& positions);
  void add(const TriangleMesh& mesh);  ///< its vertices that triangles have
  void add(const Outline& other);
  /// [m]; empty when nothing was added
  [[nodiscard]] std::vector<Vec3d> points() const;
  /// The extreme points, rotated through a full turn about the vertical axis of their box.
  [[nodiscard]] std::vector<Vec3d> points_turning() const;

 private:
  static constexpr int side_count = 134;  // 128 on a spiral, and along the axes
  std::array<Vec3d, side_count> sides_;
  std::array<Vec3d, side_count> farthest_;
  std::array<double, side_count> distance_;
};

}  // namespace weft
