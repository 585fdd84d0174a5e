#pragma once

#include "weft/simulation.h"

namespace weft {

/// Whether a walk can begin with them.
constexpr bool is_valid(const StepLevels& levels) {
  return levels.first >= 0 && levels.first <= levels.most && levels.most >= 1 &&
         levels.most <= StepLevels::deepest;
}

/// How a step was found that had been tried.
enum class StepVerdict {
  calm,    ///< far from being refused
  near,    ///< not refused
  forced,  ///< would have been refused if it might be halved
};

/// The way through a substep in steps of changing levels: a step that is refused is done as two
/// halves; what is done in calm steps goes on in longer ones, no longer than the first.
class StepWalk {
 public:
  /// @param least  level that what moves asks for
  StepWalk(int least, const StepLevels& levels);

  [[nodiscard]] bool done() const { return done_ == whole; }
  [[nodiscard]] int subdivisions() const { return 1 << level_; }
  /// Steps of the present length that come before this one.
  [[nodiscard]] int index() const { return done_ >> (StepLevels::deepest - level_); }
  [[nodiscard]] bool may_halve() const { return level_ < most_; }
  /// Whether the step is shorter than what moves asks for.
  [[nodiscard]] bool is_shortened() const { return level_ > least_; }
  void halve();
  void accept(StepVerdict verdict);
  /// Levels for the next substep: it begins where this one ended, one level longer if that was
  /// calm.
  [[nodiscard]] StepLevels next(const StepLevels& levels) const;

 private:
  static constexpr int whole = 1 << StepLevels::deepest;
  int least_, first_, level_, most_;
  int done_ = 0;  // in the shortest steps
  bool calm_ = true, forced_ = false, halved_ = false;
};

}  // namespace weft
