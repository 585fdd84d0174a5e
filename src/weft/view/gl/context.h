#pragma once

#include <memory>

namespace weft::gl {

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
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace weft::gl
