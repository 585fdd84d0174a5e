#pragma once

#include <memory>

namespace weft::gl {

/// An OpenGL 3.3 core context without window or display server, through EGL; hardware where there
/// is some, software (Mesa) otherwise.
class Context {
 public:
  /// Makes the context and makes it current. @throws Error saying what is missing
  Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context();
  /// Drawing and freeing of its objects need it current on the calling thread. @throws Error
  void make_current();

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace weft::gl
