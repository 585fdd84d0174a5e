#pragma once

#include <array>
#include <memory>

#include "weft/drawing.h"
#include "weft/grid.h"
#include "weft/picture.h"

namespace weft {

/// Draws scenes into a window by the current OpenGL 3.3 context, as Renderer draws them into
/// pictures. To be made, used and destroyed while that context is current.
class WindowCanvas {
 public:
  /// @throws Error when the driver refuses a shader
  WindowCanvas();
  WindowCanvas(const WindowCanvas&) = delete;
  WindowCanvas& operator=(const WindowCanvas&) = delete;
  ~WindowCanvas();
  /// @param size   of the window's framebuffer [pixels]
  /// @param pixel  side of a drawn pixel [framebuffer pixels]
  void paint(const DrawnScene& scene, std::array<int, 2> size, int pixel);
  /// Loads positions as colours, in their own box, into a texture that stays the same.
  /// @param positions  [n x n] [m]  @return the texture's name
  unsigned load_image(const Planes3& positions);
  /// What the window's framebuffer holds, top row first.
  [[nodiscard]] static Picture read(std::array<int, 2> size);

 private:
  struct Device;
  std::unique_ptr<Device> device_;
};

}  // namespace weft
