#include "weft/sim/stepping/step_levels.h"

#include <algorithm>

namespace weft {

StepWalk::StepWalk(int least, const StepLevels& levels)
    : least_(least),
      first_(std::max(least, levels.first)),
      level_(first_),
      most_(std::max(first_, levels.most)) {}

void StepWalk::halve() {
  ++level_;
  halved_ = true;
  calm_ = false;
}

void StepWalk::accept(StepVerdict verdict) {
  done_ += whole >> level_;
  calm_ = calm_ && verdict == StepVerdict::calm;
  if (verdict == StepVerdict::forced) {
    // Halving has not helped: the rest goes as it is.
    forced_ = true;
    most_ = level_;
  }
  const bool aligned = level_ > 0 && done_ % (whole >> (level_ - 1)) == 0;
  if (level_ > first_ && aligned && verdict == StepVerdict::calm) --level_;
}

StepLevels StepWalk::next(const StepLevels& levels) const {
  StepLevels next = levels;
  if (halved_)
    next.first = level_;
  else if (calm_)
    next.first = std::max(0, levels.first - 1);
  next.most = std::clamp(levels.most + (forced_ ? -1 : 1), 1, StepLevels::deepest);
  next.first = std::min(next.first, next.most);
  return next;
}

}  // namespace weft
