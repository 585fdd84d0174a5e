#include "weft/core/thread_team.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <system_error>

#include <pthread.h>

#include "weft/core/assert.h"

namespace weft {
namespace {

constexpr int spins_before_yield = 2000;
/// Looks at the next region before a worker sleeps: about 20 microseconds.
constexpr int spins_before_sleep = 1000;
/// Waiting time in a region below which the machine does not count as crowded. [s]
constexpr double min_loss = 2e-4;
/// Bounds of the number of regions that the caller runs alone after a crowded one: it doubles with
/// each crowded region and halves with each parallel one that is not.
constexpr int min_alone = 32, max_alone = 1024;

/// Tells the processor that a loop waits.
inline void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Forks from the process that first asked to this one.
int fork_count() {
  static std::atomic<int> count{0};
  static const int told = pthread_atfork(nullptr, nullptr, [] { ++count; });
  return told == 0 ? count.load(std::memory_order_relaxed) : 0;
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

ThreadTeam::ThreadTeam(const TeamOptions& options)
    : size_(options.size), set_(options.instructions) {
  WEFT_ASSERT(size_ >= 1);
  WEFT_ASSERT(has_instruction_set(set_));
  threads_.reserve(static_cast<std::size_t>(size_ - 1));
  start_workers();
}

void ThreadTeam::start_workers() {
  forks_ = fork_count();
  try {
    for (int rank = 1; rank < size_; ++rank) threads_.emplace_back([this, rank] { serve(rank); });
  } catch (const std::system_error&) {  // the system has no more of them
    size_ = static_cast<int>(threads_.size()) + 1;
  }
}

void ThreadTeam::forget_workers() {
  // Made anew in their places: a mutex may be locked for ever, and to destroy a condition or a
  // thread would be to wait for threads that are not in this process.
  std::construct_at(&mutex_);
  std::construct_at(&wake_);
  for (std::thread& thread : threads_) std::construct_at(&thread);
  threads_.clear();
  region_ = 0;
  asleep_ = 0;
  arrived_ = 0;
}

ThreadTeam::~ThreadTeam() {
  if (forks_ != fork_count()) forget_workers();
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadTeam::run_task(Task task) {
  if (size_ == 1 || alone_ > 0) {
    alone_ = std::max(0, alone_ - 1);
    Worker self(*this, 0, 1);
    return task.call(task.context, self);
  }
  if (forks_ != fork_count()) {
    forget_workers();
    start_workers();
  }
  const Clock::time_point start = Clock::now();
  lost_seconds_ = 0;
  bool sleepers = false;
  {
    const std::lock_guard lock(mutex_);
    task_ = task;
    region_.fetch_add(1, std::memory_order_release);
    sleepers = asleep_ > 0;
  }
  if (sleepers) wake_.notify_all();
  Worker self(*this, 0, size_);
  task.call(task.context, self);
  wait_for_all(true);
  adapt_size(seconds_since(start));
}

void ThreadTeam::adapt_size(double seconds) {
  const bool crowded = lost_seconds_ > min_loss && lost_seconds_ > 0.5 * seconds;
  next_alone_ = crowded ? std::clamp(2 * next_alone_, min_alone, max_alone) : next_alone_ / 2;
  if (crowded) alone_ = next_alone_;
}

void ThreadTeam::serve(int rank) {
  std::uint64_t seen = 0;
  while (wait_for_region(seen)) {
    const Task task = task_;
    Worker self(*this, rank, size_);
    task.call(task.context, self);
    wait_for_all(false);
  }
}

bool ThreadTeam::wait_for_region(std::uint64_t& seen) {
  const auto has_come = [&] { return region_.load(std::memory_order_acquire) != seen; };
  for (int spins = 0; spins < spins_before_sleep && !has_come(); ++spins) pause();
  if (!has_come()) {
    std::unique_lock lock(mutex_);
    ++asleep_;
    wake_.wait(lock, [&] { return stop_ || has_come(); });
    --asleep_;
  }
  if (!has_come()) return false;
  // The next region does not begin before this worker is done with this one.
  ++seen;
  return true;
}

void ThreadTeam::wait_for_all(bool caller) {
  const std::uint64_t phase = phase_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) == size_ - 1) {
    arrived_.store(0, std::memory_order_relaxed);
    phase_.store(phase + 1, std::memory_order_release);
    return;
  }
  const auto here = [&] { return phase_.load(std::memory_order_acquire) != phase; };
  for (int spins = 0; spins < spins_before_yield; ++spins)
    if (here()) return;
  const Clock::time_point start = Clock::now();
  while (!here()) std::this_thread::yield();
  if (caller) lost_seconds_ += seconds_since(start);
}

}  // namespace weft
