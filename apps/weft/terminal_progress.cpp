#include "apps/weft/terminal_progress.h"

#include <csignal>

#include <fmt/core.h>
#include <unistd.h>

#include "weft/core/error.h"

namespace weft::app {
namespace {

// A signal handler can reach nothing else: the one mutable global.
volatile std::sig_atomic_t stop_requested = 0;  // NOLINT

extern "C" void request_stop(int signal) {
  stop_requested = 1;
  (void)std::signal(signal, SIG_DFL);
}

}  // namespace

void stop_on_signals() {
  (void)std::signal(SIGINT, request_stop);
  (void)std::signal(SIGTERM, request_stop);
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
