#include "weft/view/gl/context.h"

#include <array>
#include <string>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "weft/error.h"

namespace weft::gl {
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

}  // namespace

struct Context::Handles {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

Context::Context() : handles_(std::make_unique<Handles>()) {
  handles_->display = open_display();
  if (!epoxy_has_egl_extension(handles_->display, "EGL_KHR_surfaceless_context"))
    fail("the EGL display cannot draw without a surface");
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) fail("EGL offers no OpenGL");
  constexpr std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                             3,
                                             EGL_CONTEXT_MINOR_VERSION,
                                             3,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                             EGL_NONE};
  handles_->context = eglCreateContext(handles_->display, choose_config(handles_->display),
                                       EGL_NO_CONTEXT, attributes.data());
  if (handles_->context == EGL_NO_CONTEXT) fail("no OpenGL 3.3 core context can be made");
  make_current();
}

Context::~Context() {
  eglMakeCurrent(handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(handles_->display, handles_->context);
}

void Context::make_current() {
  if (eglGetCurrentContext() == handles_->context) return;
  if (eglMakeCurrent(handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, handles_->context) !=
      EGL_TRUE)
    fail("the OpenGL context cannot be made current");
}

}  // namespace weft::gl
