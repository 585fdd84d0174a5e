#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

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
  // What the line is made of; any of them may be empty.
  [[nodiscard]] const std::string& where() const { return parts_->where; }
  [[nodiscard]] const std::string& found() const { return parts_->found; }
  [[nodiscard]] const std::string& wanted() const { return parts_->wanted; }

 private:
  struct Parts {
    std::string where, found, wanted;
  };
  ExitCode code_;
  std::shared_ptr<const Parts> parts_;  // shared, so that copies do not throw
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

/// A cloth of a simulation that ran away.
class Unstable : public SceneError {
 public:
  /// Where it was seen first.
  struct Place {
    int frame = 0;  ///< from 1
    std::string cloth;
    int row = -1, col = -1;  ///< of the sample; -1 where no single one tells
  };
  Unstable(std::string_view where, std::string_view found, std::string_view wanted, Place place)
      : SceneError(where, found, wanted), place_(std::make_shared<const Place>(std::move(place))) {}
  [[nodiscard]] const Place& place() const { return *place_; }

 private:
  std::shared_ptr<const Place> place_;
};

/// The user asked to stop.
class Interrupted : public Error {
 public:
  Interrupted() : Error(ExitCode::interrupted, "", "interrupted", "") {}
};

}  // namespace weft
