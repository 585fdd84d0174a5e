#include "python/src/calls.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "weft/error.h"

namespace weft::python {
namespace {

namespace py = pybind11;
using namespace std::chrono_literals;

constexpr auto look_interval = 40ms;   // between two looks for signals
constexpr auto stop_patience = 500ms;  // for work that was asked to stop

/// What the calling thread and the working one share; the last of both frees it.
class Shared final : public Progress {
 public:
  void update(std::string_view stage, double fraction) override {
    if (stop) throw Interrupted();
    const std::lock_guard lock(mutex_);
    stage_ = stage;
    fraction_ = fraction;
    told_ = true;
  }

  void finish(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    error_ = std::move(error);
    done_ = true;
    wake_.notify_all();
  }

  /// @return whether the work is done  @pre the interpreter's lock is not held
  bool wait(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return wake_.wait_for(lock, time, [this] { return done_; });
  }

  /// Hands on what was told since the last call.
  void tell(const py::object& progress) {
    std::unique_lock lock(mutex_);
    if (!std::exchange(told_, false) || progress.is_none()) return;
    const std::string stage = stage_;
    const double fraction = fraction_;
    lock.unlock();
    progress(stage, fraction);
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

  std::atomic<bool> stop = false;

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false, told_ = false;
  std::string stage_;
  double fraction_ = 0;
  std::exception_ptr error_;
};

bool wait_released(Shared& shared, std::chrono::milliseconds time) {
  const Released released;
  return shared.wait(time);
}

/// Waits for the work, looking for signals and telling of progress. @throws py::error_already_set
void attend(Shared& shared, const py::object& progress) {
  while (!wait_released(shared, look_interval)) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    shared.tell(progress);
  }
  shared.tell(progress);
}

}  // namespace

Released::~Released() {
  try {
    PyEval_RestoreThread(state_);
  } catch (...) {
    // The thread is being unwound, to end. To wait here keeps what it holds as it is.
    for (;;) std::this_thread::sleep_for(1h);
  }
}

void run_released(const py::object& progress, std::function<void(Progress&)> work) {
  const auto shared = std::make_shared<Shared>();
  std::thread worker([shared, work = std::move(work)]() mutable {
    std::exception_ptr error;
    try {
      work(*shared);
    } catch (...) {
      error = std::current_exception();
    }
    work = nullptr;  // frees what it owns before the caller goes on
    shared->finish(std::move(error));
  });
  try {
    attend(*shared, progress);
  } catch (...) {
    shared->stop = true;
    if (wait_released(*shared, stop_patience))
      worker.join();
    else
      worker.detach();
    throw;
  }
  worker.join();
  shared->rethrow();
}

}  // namespace weft::python
