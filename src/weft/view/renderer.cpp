#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "weft/drawing.h"
#include "weft/error.h"
#include "weft/view/gl/objects.h"
#include "weft/view/gl/scene_painter.h"

namespace weft {
namespace {

[[noreturn]] void fail(const std::string& found) {
  throw Error(ExitCode::internal, "OpenGL", found,
              "EGL with a driver for OpenGL 3.3 core is wanted (Debian: libegl1, libgl1-mesa-dri)");
}

bool has_client_extension(const char* name) {
  return epoxy_has_egl_extension(EGL_NO_DISPLAY, name);
}

/// The first display that can be opened. It belongs to the whole process (asking again gives the
/// same one), so it is never terminated: that would end the contexts of other renderers.
EGLDisplay open_display() {
  const bool platforms = has_client_extension("EGL_EXT_platform_base");
  std::array<EGLDisplay, 3> candidates{EGL_NO_DISPLAY, EGL_NO_DISPLAY, EGL_NO_DISPLAY};
  if (platforms && has_client_extension("EGL_MESA_platform_surfaceless"))
    candidates[0] =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (platforms && has_client_extension("EGL_EXT_platform_device"))
    candidates[1] = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, EGL_DEFAULT_DISPLAY, nullptr);
  candidates[2] = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  for (const EGLDisplay display : candidates)
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE)
      return display;
  fail("no EGL display can be opened");
}

EGLConfig choose_config(EGLDisplay display) {
  if (epoxy_has_egl_extension(display, "EGL_KHR_no_config_context")) return EGL_NO_CONFIG_KHR;
  constexpr std::array<EGLint, 3> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count < 1)
    fail("the EGL display has no configuration for OpenGL");
  return config;
}

/// An OpenGL 3.3 core context without window or display server, through EGL; hardware where
/// available, software (Mesa) otherwise.
class Context {
 public:
  /// Creates the context and makes it current. @throws Error saying what is missing
  Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context();
  /// Makes the context current on the calling thread, as needed to draw with its objects and to
  /// free them. @throws Error
  void make_current();

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

Context::Context() : display_(open_display()) {
  if (!epoxy_has_egl_extension(display_, "EGL_KHR_surfaceless_context"))
    fail("the EGL display cannot draw without a surface");
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) fail("EGL offers no OpenGL");
  constexpr std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                             3,
                                             EGL_CONTEXT_MINOR_VERSION,
                                             3,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                             EGL_NONE};
  context_ = eglCreateContext(display_, choose_config(display_), EGL_NO_CONTEXT, attributes.data());
  if (context_ == EGL_NO_CONTEXT) fail("no OpenGL 3.3 core context can be made");
  make_current();
}

Context::~Context() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void Context::make_current() {
  if (eglGetCurrentContext() == context_) return;
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
    fail("the OpenGL context cannot be made current");
}

constexpr int samples = 4;
constexpr int largest_side = 16384;

std::array<int, 2> checked_size(int width, int height) {
  if (std::min(width, height) < 1 || std::max(width, height) > largest_side)
    throw Error(ExitCode::usage, "picture size", "a side is out of range",
                "1 to 16384 pixels are wanted");
  return {width, height};
}

}  // namespace

struct Renderer::Device {
  std::array<int, 2> size;
  Context context;
  gl::ScenePainter painter;
  gl::Canvas drawn, averaged;

  Device(int width, int height)
      : size(checked_size(width, height)),
        drawn(gl::make_canvas(samples, size)),
        averaged(gl::make_canvas(0, size)) {}
};

Renderer::Renderer(int width, int height) : device_(std::make_unique<Device>(width, height)) {}

Renderer::~Renderer() {
  // Resources are freed in their own context: another renderer of this thread may be current.
  if (device_) device_->context.make_current();
}

Picture Renderer::draw(const DrawnScene& scene) {
  Device& device = *device_;
  const auto [width, height] = device.size;
  device.context.make_current();
  device.painter.paint(scene, {device.drawn.target.name(), width, height});
  glBindFramebuffer(GL_READ_FRAMEBUFFER, device.drawn.target.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, device.averaged.target.name());
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  return gl::read_picture(device.averaged.target.name(), {width, height});
}

}  // namespace weft
