#pragma once

#include <functional>

#include <pybind11/pybind11.h>

#include "weft/progress.h"

namespace weft::python {

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

}  // namespace weft::python
