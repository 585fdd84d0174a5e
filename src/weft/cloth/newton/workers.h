#pragma once

#include "weft/core/thread_team.h"

namespace weft {

/// Who works on a level: all workers of a team, or one whom the others wait for.
class Workers {
 public:
  Workers(Worker& worker, bool alone)  // alone: only the worker of rank 0 may call
      : worker_(&worker), alone_(alone) {}
  [[nodiscard]] Range share(int count) const {
    return alone_ ? Range{0, count} : worker_->share(count);
  }
  void barrier() const {
    if (!alone_) worker_->barrier();
  }
  [[nodiscard]] int rank() const { return worker_->rank(); }
  [[nodiscard]] bool alone() const { return alone_ || worker_->alone(); }
  [[nodiscard]] Worker& worker() const { return *worker_; }

 private:
  Worker* worker_;
  bool alone_;
};

}  // namespace weft
