#pragma once

struct GLFWwindow;

namespace weft::viewer {

/// Dear ImGui on a window while it lives, dressed for this program. The window's callbacks are
/// kept.
class PanelContext {
 public:
  /// @param scale  how large text shall be, 1 on a usual screen
  PanelContext(GLFWwindow* window, double scale);
  PanelContext(const PanelContext&) = delete;
  PanelContext& operator=(const PanelContext&) = delete;
  ~PanelContext();

  static void begin();  ///< a frame
  static void draw();   ///< what was put into it since
};

}  // namespace weft::viewer
