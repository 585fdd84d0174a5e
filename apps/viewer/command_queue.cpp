#include "apps/viewer/command_queue.h"

#include <algorithm>

namespace weft::viewer {
namespace {

bool replaces(const Command& next, const Command& last) {
  return next.index() == last.index() &&
         (std::holds_alternative<Pull>(next) || std::holds_alternative<Change>(next) ||
          std::holds_alternative<Recolour>(next));
}

bool makes_anew(const Command& command) {
  return std::holds_alternative<Open>(command) || std::holds_alternative<DrapeOver>(command);
}

}  // namespace

void CommandQueue::push(Command command) {
  {
    const std::scoped_lock lock(mutex_);
    if (!waiting_.empty() && replaces(command, waiting_.back()))
      waiting_.back() = std::move(command);
    else
      waiting_.push_back(std::move(command));
  }
  wake_.notify_one();
}

void CommandQueue::take(std::vector<Command>& commands) {
  commands.clear();
  const std::scoped_lock lock(mutex_);
  commands.swap(waiting_);
}

bool CommandQueue::wait_until(std::chrono::steady_clock::time_point time) {
  std::unique_lock lock(mutex_);
  wake_.wait_until(lock, time, [&] { return stopped_ || !waiting_.empty(); });
  return !waiting_.empty();
}

void CommandQueue::stop() {
  {
    const std::scoped_lock lock(mutex_);
    stopped_ = true;
  }
  wake_.notify_one();
}

bool CommandQueue::stopped() const {
  const std::scoped_lock lock(mutex_);
  return stopped_;
}

bool CommandQueue::is_overtaken() const {
  const std::scoped_lock lock(mutex_);
  return stopped_ || std::any_of(waiting_.begin(), waiting_.end(), makes_anew);
}

}  // namespace weft::viewer
