#pragma once

#include <chrono>
#include <string>

#include "weft/progress.h"

namespace weft::app {

/// From now on Ctrl-C (SIGINT) and SIGTERM ask for a stop at the next progress update; a second one
/// kills.
void stop_on_signals();

/// While one lives, a stop that is asked for ends the program within a second even where the work
/// tells no progress, as a large factorization does. For work that has nothing half-written. One
/// at a time.
class PromptStop {
 public:
  /// @throws Interrupted when a stop has been asked for
  PromptStop();
  PromptStop(const PromptStop&) = delete;
  PromptStop& operator=(const PromptStop&) = delete;
  ~PromptStop();
};

/// A bar on stderr when that is a terminal (nothing otherwise); throws Interrupted when asked to
/// stop.
class TerminalProgress : public Progress {
 public:
  explicit TerminalProgress(bool quiet);
  ~TerminalProgress() override;
  void update(std::string_view stage, double fraction) override;
  /// Takes the bar away until the next update, for a line that is to stay.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool visible_;
  std::string stage_;
  std::size_t drawn_ = 0;
  Clock::time_point last_;
};

}  // namespace weft::app
