#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <span>
#include <thread>
#include <type_traits>
#include <vector>

#include "weft/core/instruction_set.h"

namespace weft {

/// A half-open range of rows, samples or the like.
struct Range {
  int first = 0, last = 0;
  bool operator==(const Range&) const = default;
};

class ThreadTeam;

/// One member of a team inside a parallel region.
class Worker {
 public:
  /// A worker without a team, for work that is not shared, also inside a team's region.
  static Worker lone() { return {}; }
  /// This worker's part of 0 .. count - 1: contiguous, fixed by rank and team size. Results must
  /// not depend on it, so that any team gives the same bits.
  [[nodiscard]] Range share(int count) const {
    const auto part = [&](int r) { return static_cast<int>(std::int64_t{count} * r / size_); };
    return {part(rank_), part(rank_ + 1)};
  }
  [[nodiscard]] int rank() const { return rank_; }
  /// Number of workers in this region; it may differ between regions.
  [[nodiscard]] int size() const { return size_; }
  /// Whether this is the only worker in this region.
  [[nodiscard]] bool alone() const { return size_ == 1; }
  /// Waits until every worker of the region has reached the barrier.
  void barrier();

 private:
  friend class ThreadTeam;
  Worker() = default;
  Worker(ThreadTeam& team, int rank, int size) : team_(&team), rank_(rank), size_(size) {}
  ThreadTeam* team_ = nullptr;
  int rank_ = 0, size_ = 1;
};

/// A fixed team of threads that runs parallel regions; whole algorithms with many barriers stay
/// inside one region. `run` allocates nothing. The caller is worker 0, so a team of one starts no
/// thread.
///
/// On a crowded machine a barrier may wait for a worker that is not running. After a region that
/// lost most of its time this way the caller runs some regions alone. Results do not depend on the
/// team, so only the time differs.
///
/// In the child of a fork, which has none of its threads, a team starts them anew in its next
/// region. One that was in a region meanwhile, by another thread, can only be destroyed there.
class ThreadTeam {
 public:
  /// As many workers as are asked for, or as the system has threads for.
  explicit ThreadTeam(const TeamOptions& options);
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;
  ~ThreadTeam();

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] InstructionSet instructions() const { return set_; }

  /// Calls body(worker) on every worker and returns when all are done. The body must not throw.
  template <class Body>
  void run(Body&& body) {
    using Plain = std::remove_reference_t<Body>;
    run_task({[](void* context, Worker& worker) { (*static_cast<Plain*>(context))(worker); },
              const_cast<void*>(static_cast<const void*>(&body))});
  }

  /// The same, or by the caller alone where there is too little to share.
  template <class Body>
  void run_if(bool worth_sharing, Body&& body) {
    if (worth_sharing) return run(body);
    Worker lone = Worker::lone();
    body(lone);
  }

 private:
  friend class Worker;
  struct Task {
    void (*call)(void*, Worker&) = nullptr;
    void* context = nullptr;
  };
  void run_task(Task task);
  void start_workers();
  /// Makes all as if no worker had been started, without a word to those of before a fork.
  void forget_workers();
  void serve(int rank);
  /// Waits for the region after the one that a worker saw last. @return false: there is none left
  bool wait_for_region(std::uint64_t& seen);
  void wait_for_all(bool caller);
  void adapt_size(double seconds);

  int size_;
  InstructionSet set_;
  int forks_ = 0;  // before the workers were started, as fork_count tells
  Task task_;
  // Workers spin briefly, then sleep, between regions, and spin briefly, then yield, at barriers
  // inside one: waking a sleeper takes as long as many a region.
  std::mutex mutex_;
  std::condition_variable wake_;
  std::atomic<std::uint64_t> region_{0};  // changed under the mutex, after the task
  int asleep_ = 0;                        // workers that wait for a signal
  bool stop_ = false;
  std::atomic<int> arrived_{0};
  std::atomic<std::uint64_t> phase_{0};
  std::vector<std::thread> threads_;
  // Used by the caller alone.
  double lost_seconds_ = 0;  // waiting time in this region after spinning
  int alone_ = 0;            // regions yet to be run by the caller alone
  int next_alone_ = 0;       // doubled by a crowded region, which sets alone_ to it; else halved
};

inline void Worker::barrier() {
  if (size_ > 1) team_->wait_for_all(rank_ == 0);
}

}  // namespace weft
