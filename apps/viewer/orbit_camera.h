#pragma once

#include "weft/camera.h"

namespace weft::viewer {

/// A ray of sight.
struct Ray {
  Vec3d from;
  Vec3d direction;  ///< unit
};

/// A camera that the user orbits about its target. Positions in the window are in pixels from its
/// upper left corner.
class OrbitCamera {
 public:
  /// Sets the size of the window, and the width that is covered at its left [pixels].
  void resize(int width, int height, int covered);
  /// Frames a box from the current direction.
  void frame(const Box3d& box);

  /// Orbits or pans by a displacement of the mouse [pixels].
  void orbit(Vec2d displacement);
  void pan(Vec2d displacement);
  /// Zooms by steps of the wheel, towards the point under the mouse.
  void zoom(double steps, Vec2d at);

  [[nodiscard]] Camera camera() const;
  [[nodiscard]] Ray ray_through(Vec2d pixel) const;
  /// Intersection of a pixel's ray with the plane through a point that faces the camera.
  [[nodiscard]] Vec3d on_facing_plane(Vec2d pixel, Vec3d point) const;
  /// Pixel of a point; far outside the window for one behind the eye.
  [[nodiscard]] Vec2d pixel_of(Vec3d point) const;

 private:
  struct Axes {
    Vec3d right, up, back;
  };
  [[nodiscard]] Axes axes() const;
  /// Size of a pixel at the target's distance [m].
  [[nodiscard]] double pixel_size() const;

  int width_ = 1280, height_ = 720, covered_ = 0;
  double azimuth_ = 0.45, elevation_ = 0.25;  // of the eye [rad]; azimuth 0 looks from +z
  double distance_ = 3;                       // [m]
  Vec3d target_;
};

}  // namespace weft::viewer
