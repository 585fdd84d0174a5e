#pragma once

#include <array>

#include "weft/view/gl/canvas.h"
#include "weft/view/gl/scene_painter.h"

namespace weft::viewer {

/// Draws scenes into the window's framebuffer, by the renderer that draws files.
class SceneCanvas {
 public:
  /// @param size   of the framebuffer [pixels]
  /// @param pixel  of the framebuffer's pixels, along each side, that one drawn one covers
  void paint(const DrawnScene& scene, std::array<int, 2> size, int pixel);

 private:
  void fit(std::array<int, 2> size, int samples);

  gl::ScenePainter painter_;
  gl::Canvas canvas_;
  std::array<int, 2> size_{};  // of the canvas
  int samples_ = -1;
};

}  // namespace weft::viewer
