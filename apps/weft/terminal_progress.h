#pragma once

#include <chrono>
#include <string>

#include "weft/progress.h"

namespace weft::app {

/// Makes Ctrl-C (SIGINT) and SIGTERM ask for a stop at the next progress update; a second one
/// kills.
void stop_on_signals();

/// While a PromptStop exists, a requested stop ends the program within a second, even during work
/// without progress updates, such as a large factorization. For work that has nothing half-written.
/// One at a time.
class PromptStop {
 public:
  /// @throws Interrupted when a stop has been asked for
  PromptStop();
  PromptStop(const PromptStop&) = delete;
  PromptStop& operator=(const PromptStop&) = delete;
  ~PromptStop();
};

/// A progress bar on stderr when that is a terminal (nothing otherwise); throws Interrupted when a
/// stop was requested.
class TerminalProgress : public Progress {
 public:
  explicit TerminalProgress(bool quiet);
  ~TerminalProgress() override;
  void update(std::string_view stage, double fraction) override;
  /// Removes the bar until the next update, so that a line can be printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool visible_;
  std::string stage_;
  std::size_t drawn_ = 0;
  Clock::time_point last_;
};

}  // namespace weft::app
