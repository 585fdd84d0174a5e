#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <pybind11/pybind11.h>

#include "weft/progress.h"

namespace weft::python {

/// Lets other threads of the interpreter run while it lives. As pybind11's gil_scoped_release; but
/// where the interpreter has ended meanwhile, its thread, a daemon, waits for the process to end,
/// too: Python would unwind it, which no destructor survives.
class Released {
 public:
  Released() : state_(PyEval_SaveThread()) {}
  Released(const Released&) = delete;
  Released& operator=(const Released&) = delete;
  ~Released();

 private:
  PyThreadState* state_;
};

/// Runs long work without the interpreter's lock, on a thread of its own. The calling thread waits,
/// hands on progress to a callable, and looks for signals.
///
/// Where a signal's handler or the callable raises, the work is asked to stop, which it does at its
/// next report of progress. Where that takes too long for a user who pressed Ctrl-C, the call
/// returns all the same, and the work ends by itself later: it must own what it uses, and nothing
/// of it may be an object of the interpreter.
/// @param progress  None, or called with (stage, fraction of the stage), some twenty times a second
/// at most
/// @throws what the work throws; what the callable or a signal's handler raised
void run_released(const pybind11::object& progress, std::function<void(Progress&)> work);

/// The same, for work that makes something and tells no progress. @return what it makes
template <class Make>
auto made_released(Make make) {
  using Made = decltype(make());
  const auto made = std::make_shared<std::optional<Made>>();
  run_released(pybind11::none(), [made, make = std::move(make)](Progress&) { *made = make(); });
  return std::move(**made);
}

}  // namespace weft::python
