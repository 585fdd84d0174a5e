#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace weft {

/// Exit codes of the program, a contract with its callers.
enum class ExitCode {
  done = 0,
  internal = 1,
  usage = 2,
  input = 3,
  check_failed = 4,
  interrupted = 130
};

/// Every error that Weft throws: where, what was found, what is wanted, in one line.
class Error : public std::runtime_error {
 public:
  /// @param where  a file, FILE:LINE, a scene key, or empty
  Error(ExitCode code, std::string_view where, std::string_view found, std::string_view wanted);
  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// A command line that does not parse or asks for what does not exist.
class UsageError : public Error {
 public:
  UsageError(std::string_view where, std::string_view found, std::string_view wanted)
      : Error(ExitCode::usage, where, found, wanted) {}
};

/// A file that is missing, cut short, or not what it says it is.
class InputError : public Error {
 public:
  InputError(std::string_view where, std::string_view found, std::string_view wanted)
      : Error(ExitCode::input, where, found, wanted) {}
};

/// A place that cannot be written.
class OutputError : public Error {
 public:
  OutputError(std::string_view where, std::string_view found, std::string_view wanted)
      : Error(ExitCode::input, where, found, wanted) {}
};

/// A mesh whose surface cannot become an image: non-manifold, non-orientable, several components.
class TopologyError : public Error {
 public:
  TopologyError(std::string_view where, std::string_view found, std::string_view wanted)
      : Error(ExitCode::input, where, found, wanted) {}
};

/// A scene with an unknown key, a value out of range, or settings that do not work together.
class SceneError : public Error {
 public:
  SceneError(std::string_view where, std::string_view found, std::string_view wanted)
      : Error(ExitCode::input, where, found, wanted) {}
};

/// The user asked to stop.
class Interrupted : public Error {
 public:
  Interrupted() : Error(ExitCode::interrupted, "", "interrupted", "") {}
};

}  // namespace weft
