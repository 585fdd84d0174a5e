#pragma once

#include <memory>

#include "weft/view/drawn_scene.h"
#include "weft/view/movie_writer.h"
#include "weft/view/picture.h"

namespace weft {

/// Draws scenes offscreen through EGL without a display (software or hardware). One renderer a
/// thread.
class Renderer {
 public:
  /// @throws Error when no OpenGL 3.3 core context can be made, saying what is missing
  Renderer(int width, int height);
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  ~Renderer();
  /// Buffers are kept between calls: drawing the same surfaces moved is cheaper than new ones.
  Picture draw(const DrawnScene& scene);

 private:
  struct Device;
  std::unique_ptr<Device> device_;
};

}  // namespace weft
