#pragma once

#include <optional>

#include "weft/core/stopwatch.h"

namespace weft {

/// Decides after which frames a checkpoint is written.
class CheckpointClock {
 public:
  explicit CheckpointClock(std::optional<int> frames) : frames_(frames) {}
  [[nodiscard]] bool off() const { return frames_ == 0; }
  [[nodiscard]] bool is_due(int frame) const {
    if (frames_) return *frames_ > 0 && frame % *frames_ == 0;
    return since_.seconds() >= default_seconds;
  }
  void written() { since_ = {}; }

 private:
  /// Default time between checkpoints: the work that a killed run may lose [s].
  static constexpr double default_seconds = 5;
  std::optional<int> frames_;
  Stopwatch since_;  // the last checkpoint
};

}  // namespace weft
