#include "apps/weft/terminal_progress.h"

#include <csignal>

#include <fmt/core.h>
#include <unistd.h>

#include "weft/error.h"

namespace weft::app {
namespace {

// Signal handlers can reach nothing else: the only mutable globals.
volatile std::sig_atomic_t stop_requested = 0;   // NOLINT
volatile std::sig_atomic_t may_end_at_once = 0;  // NOLINT

// Time that work without progress updates may go on after a stop was requested [s].
constexpr unsigned grace = 1;

extern "C" void end_at_once(int /*signal*/) {
  if (may_end_at_once == 0) return;
  constexpr std::string_view line = "weft: error: interrupted\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
  ::_exit(static_cast<int>(ExitCode::interrupted));
}

extern "C" void request_stop(int signal) {
  stop_requested = 1;
  if (may_end_at_once != 0) (void)::alarm(grace);
  (void)std::signal(signal, SIG_DFL);
}

}  // namespace

void stop_on_signals() {
  (void)std::signal(SIGINT, request_stop);
  (void)std::signal(SIGTERM, request_stop);
  (void)std::signal(SIGALRM, end_at_once);
}

PromptStop::PromptStop() {
  if (stop_requested != 0) throw Interrupted();
  may_end_at_once = 1;
}

PromptStop::~PromptStop() {
  may_end_at_once = 0;
  (void)::alarm(0);
}

TerminalProgress::TerminalProgress(bool quiet) : visible_(!quiet && isatty(STDERR_FILENO) == 1) {}

TerminalProgress::~TerminalProgress() { clear(); }

void TerminalProgress::clear() {
  if (drawn_ > 0) fmt::print(stderr, "\r{:{}}\r", "", drawn_);
  drawn_ = 0;
}

void TerminalProgress::update(std::string_view stage, double fraction) {
  if (stop_requested != 0) throw Interrupted();
  const Clock::time_point now = Clock::now();
  if (!visible_ || (stage == stage_ && now - last_ < std::chrono::milliseconds(80))) return;
  last_ = now;
  clear();
  stage_ = stage;
  constexpr int width = 30;
  const std::string bar(static_cast<std::size_t>(width * fraction), '#');
  const std::string line =
      fmt::format("{:<24} [{:<{}}] {:3.0f} %", stage, bar, width, 100 * fraction);
  fmt::print(stderr, "{}", line);
  (void)std::fflush(stderr);
  drawn_ = line.size();
}

}  // namespace weft::app
