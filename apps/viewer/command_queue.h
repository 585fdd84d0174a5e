#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <variant>
#include <vector>

#include "apps/viewer/colouring.h"
#include "weft/scene.h"

namespace weft::viewer {

// Commands of the window to the simulating thread.

struct Play {
  bool running = true;
};
struct StepOnce {};
struct Reset {};
struct Grab {
  std::size_t cloth = 0;
  int sample = 0;
};
struct Pull {
  Vec3d target;  ///< [m]
};
struct LetGo {};
/// Opens another subject.
struct Open {
  std::string subject;
};
/// Lays a cloth over what is shown, or over another body.
struct DrapeOver {
  std::string body;
};
/// Continues with a changed scene.
struct Change {
  Scene scene;
  std::string what;  ///< a few words for the status line
};
struct Recolour {
  Colouring colouring;
};
using Command =
    std::variant<Play, StepOnce, Reset, Grab, Pull, LetGo, Open, DrapeOver, Change, Recolour>;

/// Commands from one thread to another, in order. Of pulls, changes and recolourings in a row only
/// the last is kept.
class CommandQueue {
 public:
  void push(Command command);
  /// Moves all waiting commands into `commands`, which is emptied first.
  void take(std::vector<Command>& commands);
  /// Waits until there is a command, `stop` was called or the time has come.
  /// @return whether there is a command
  bool wait_until(std::chrono::steady_clock::time_point time);
  /// Ends waiting, now and from now on.
  void stop();
  [[nodiscard]] bool stopped() const;
  /// Whether a waiting command makes the current loading obsolete.
  [[nodiscard]] bool is_overtaken() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Command> waiting_;
  bool stopped_ = false;
};

}  // namespace weft::viewer
