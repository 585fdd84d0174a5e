#include "apps/viewer/window.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <epoxy/gl.h>
// After the loader, which brings OpenGL's own names.
#include <GLFW/glfw3.h>

#include "weft/error.h"

namespace weft::viewer {
namespace {

[[noreturn]] void fail(const std::string& what) {
  const char* told = nullptr;
  glfwGetError(&told);
  std::string found = told != nullptr ? told : "no reason is told";
  for (char& c : found)
    if (c == '\n') c = ' ';
  throw Error(ExitCode::input, "window", what + " (" + found + ")",
              "a desktop with OpenGL 3.3 is wanted; weft render draws without one");
}

std::optional<MouseButton> button_of(int button) {
  if (button == GLFW_MOUSE_BUTTON_LEFT) return MouseButton::left;
  if (button == GLFW_MOUSE_BUTTON_RIGHT) return MouseButton::right;
  if (button == GLFW_MOUSE_BUTTON_MIDDLE) return MouseButton::middle;
  return std::nullopt;
}

}  // namespace

/// Callbacks of GLFW, which find the window by its user pointer.
struct Window::Callbacks {
  static Window& self(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
  }
  static void add(GLFWwindow* window, Event event) {
    self(window).events_.push_back(std::move(event));
  }
  /// Cursor position at the event; GLFW itself gives the current one.
  static Vec2d cursor(GLFWwindow* window) { return self(window).cursor_; }
  static void button(GLFWwindow* window, int which, int action, int /*modifiers*/) {
    const auto known = button_of(which);
    if (!known) return;
    if (action == GLFW_PRESS)
      add(window, MousePressed{*known, cursor(window)});
    else
      add(window, MouseReleased{*known, cursor(window)});
  }
  static void moved(GLFWwindow* window, double x, double y) {
    self(window).cursor_ = {x, y};
    add(window, MouseMoved{{x, y}});
  }
  static void wheel(GLFWwindow* window, double /*across*/, double along) {
    add(window, WheelTurned{along, cursor(window)});
  }
  static void key(GLFWwindow* window, int key, int /*scancode*/, int action, int modifiers) {
    if (action != GLFW_RELEASE) add(window, KeyPressed{key, (modifiers & GLFW_MOD_SHIFT) != 0});
  }
  static void drop(GLFWwindow* window, int count, const char** paths) {
    if (count > 0) add(window, FileDropped{paths[0]});
  }
};

Window::Window(int width, int height, const std::string& title) {
  if (glfwInit() != GLFW_TRUE) fail("no display can be opened");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  // Pictures are antialiased before they are drawn here.
  glfwWindowHint(GLFW_SAMPLES, 0);
  handle_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (handle_ == nullptr) {
    try {
      fail("no window can be made");
    } catch (...) {
      glfwTerminate();
      throw;
    }
  }
  glfwMakeContextCurrent(handle_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(handle_, this);
  glfwGetCursorPos(handle_, &cursor_.x, &cursor_.y);
  glfwSetMouseButtonCallback(handle_, Callbacks::button);
  glfwSetCursorPosCallback(handle_, Callbacks::moved);
  glfwSetScrollCallback(handle_, Callbacks::wheel);
  glfwSetKeyCallback(handle_, Callbacks::key);
  glfwSetDropCallback(handle_, Callbacks::drop);
}

Window::~Window() {
  glfwDestroyWindow(handle_);
  glfwTerminate();
}

std::vector<Event> Window::wait(double seconds) {
  if (seconds > 0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
  std::vector<Event> happened;
  happened.swap(events_);
  return happened;
}

void Window::wake() { glfwPostEmptyEvent(); }
void Window::show() { glfwSwapBuffers(handle_); }
void Window::close() { glfwSetWindowShouldClose(handle_, GLFW_TRUE); }
bool Window::closes() const { return glfwWindowShouldClose(handle_) == GLFW_TRUE; }
void Window::set_title(const std::string& title) { glfwSetWindowTitle(handle_, title.c_str()); }

Vec2d Window::size() const {
  int width = 0, height = 0;
  glfwGetWindowSize(handle_, &width, &height);
  return {static_cast<double>(width), static_cast<double>(height)};
}

Vec2d Window::pixels() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(handle_, &width, &height);
  return {static_cast<double>(width), static_cast<double>(height)};
}

double Window::scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(handle_, &x, &y);
  return std::clamp(static_cast<double>(std::fmax(x, y)), 1.0, 4.0);
}

}  // namespace weft::viewer
