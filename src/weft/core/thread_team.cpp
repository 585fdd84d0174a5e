#include "weft/core/thread_team.h"

#include "weft/core/assert.h"

namespace weft {

ThreadTeam::ThreadTeam(const TeamOptions& options)
    : size_(options.size), set_(options.instructions) {
  WEFT_ASSERT(size_ >= 1);
  WEFT_ASSERT(has_instruction_set(set_));
  threads_.reserve(static_cast<std::size_t>(size_ - 1));
  for (int rank = 1; rank < size_; ++rank) threads_.emplace_back([this, rank] { serve(rank); });
}

ThreadTeam::~ThreadTeam() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadTeam::run_task(Task task) {
  if (size_ > 1) {
    {
      const std::lock_guard lock(mutex_);
      task_ = task;
      ++region_;
    }
    wake_.notify_all();
  }
  Worker self(*this, 0, size_);
  task.call(task.context, self);
  wait_for_all();
}

void ThreadTeam::serve(int rank) {
  std::uint64_t seen = 0;
  while (true) {
    Task task;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return stop_ || region_ != seen; });
      if (stop_) return;
      seen = region_;
      task = task_;
    }
    Worker self(*this, rank, size_);
    task.call(task.context, self);
    wait_for_all();
  }
}

void ThreadTeam::wait_for_all() {
  if (size_ == 1) return;
  constexpr int spins_before_yield = 2000;
  const std::uint64_t phase = phase_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) == size_ - 1) {
    arrived_.store(0, std::memory_order_relaxed);
    phase_.store(phase + 1, std::memory_order_release);
    return;
  }
  for (int spins = 0; phase_.load(std::memory_order_acquire) == phase; ++spins)
    if (spins > spins_before_yield) std::this_thread::yield();
}

}  // namespace weft
