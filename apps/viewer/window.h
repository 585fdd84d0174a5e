#pragma once

#include <string>
#include <variant>
#include <vector>

#include "weft/vec.h"

struct GLFWwindow;

namespace weft::viewer {

// What happened in the window, in order; places are in its coordinates from the upper left corner.

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

  /// Waits until something happens or the time is over. @param seconds  0: does not wait
  /// @return what happened since the last call
  std::vector<Event> wait(double seconds);
  /// Ends a `wait`, from any thread.
  static void wake();
  void show();  ///< what was drawn
  void close();
  [[nodiscard]] bool closes() const;
  void set_title(const std::string& title);

  [[nodiscard]] GLFWwindow* handle() const { return handle_; }
  /// In its own coordinates, and in pixels.
  [[nodiscard]] Vec2d size() const;
  [[nodiscard]] Vec2d pixels() const;
  /// How large text and panels shall be.
  [[nodiscard]] double scale() const;

 private:
  struct Callbacks;
  GLFWwindow* handle_ = nullptr;
  std::vector<Event> events_;
  Vec2d cursor_;  // by the last event
};

}  // namespace weft::viewer
