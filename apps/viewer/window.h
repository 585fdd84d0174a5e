#pragma once

#include <string>
#include <variant>
#include <vector>

#include "weft/vec.h"

struct GLFWwindow;

namespace weft::viewer {

// Events of the window, in order; positions are in its coordinates from the upper left corner.

enum class MouseButton { left, right, middle };
struct MousePressed {
  MouseButton button = MouseButton::left;
  Vec2d at;
};
struct MouseReleased {
  MouseButton button = MouseButton::left;
  Vec2d at;
};
struct MouseMoved {
  Vec2d at;
};
struct WheelTurned {
  double steps = 0;  ///< away from the hand
  Vec2d at;
};
struct KeyPressed {
  int key = 0;  ///< GLFW's
  bool shift = false;
};
struct FileDropped {
  std::string path;
};
using Event =
    std::variant<MousePressed, MouseReleased, MouseMoved, WheelTurned, KeyPressed, FileDropped>;

/// A window with an OpenGL 3.3 context, current on the thread that made it.
class Window {
 public:
  /// @throws Error with ExitCode::input where there is no display or no such context
  Window(int width, int height, const std::string& title);
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  ~Window();

  /// Waits for an event, or until the time is over. @param seconds  0: does not wait
  /// @return all events since the last call
  std::vector<Event> wait(double seconds);
  /// Ends a `wait`, from any thread.
  static void wake();
  void show();  ///< what was drawn
  void close();
  [[nodiscard]] bool closes() const;
  void set_title(const std::string& title);

  [[nodiscard]] GLFWwindow* handle() const { return handle_; }
  /// Size in its own coordinates, and in pixels.
  [[nodiscard]] Vec2d size() const;
  [[nodiscard]] Vec2d pixels() const;
  /// Scale of text and panels.
  [[nodiscard]] double scale() const;

 private:
  struct Callbacks;
  GLFWwindow* handle_ = nullptr;
  std::vector<Event> events_;
  Vec2d cursor_;  // by the last event
};

}  // namespace weft::viewer
