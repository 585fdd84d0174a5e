#pragma once

#include <chrono>

namespace weft {

/// Wall-clock time, for reports.
class Stopwatch {
 public:
  /// Time since construction [s].
  [[nodiscard]] double seconds() const { return between(start_, Clock::now()); }
  /// Time since the last lap, or since construction [s].
  double lap() {
    const Clock::time_point now = Clock::now(), before = last_;
    last_ = now;
    return between(before, now);
  }
  double lap_ms() { return 1000 * lap(); }

 private:
  using Clock = std::chrono::steady_clock;
  static double between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  }
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace weft
