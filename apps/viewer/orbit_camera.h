#pragma once

#include "weft/camera.h"

namespace weft::viewer {

/// A line of sight.
struct Ray {
  Vec3d from;
  Vec3d direction;  ///< unit
};

/// A camera that a hand turns about what it looks at. Places in the window are in pixels from its
/// upper left corner.
class OrbitCamera {
 public:
  /// The window's size in pixels, and how much at its left something covers.
  void resize(int width, int height, int covered);
  /// Looks at all of a box, from where it looks now.
  void frame(const Box3d& box);

  /// By a way of the mouse [pixels].
  void orbit(Vec2d displacement);
  void pan(Vec2d displacement);
  /// Nearer by steps of the wheel, towards the place under the mouse.
  void zoom(double steps, Vec2d at);

  [[nodiscard]] Camera camera() const;
  [[nodiscard]] Ray ray_through(Vec2d pixel) const;
  /// Where the ray meets the plane through a point that faces the camera.
  [[nodiscard]] Vec3d on_facing_plane(Vec2d pixel, Vec3d point) const;
  /// Where a point is seen; far outside the window for one behind the eye.
  [[nodiscard]] Vec2d pixel_of(Vec3d point) const;

 private:
  struct Axes {
    Vec3d right, up, back;
  };
  [[nodiscard]] Axes axes() const;
  /// Of a pixel at the target's distance [m].
  [[nodiscard]] double pixel_size() const;

  int width_ = 1280, height_ = 720, covered_ = 0;
  double azimuth_ = 0.45, elevation_ = 0.25;  // of the eye [rad]; azimuth 0 looks from +z
  double distance_ = 3;                       // [m]
  Vec3d target_;
};

}  // namespace weft::viewer
