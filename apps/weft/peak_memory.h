#pragma once

#include <optional>

namespace weft::app {

/// The most memory that this process has held at once so far [MB of 10^6 bytes]; nothing where the
/// system does not tell.
std::optional<double> peak_memory_mb();

}  // namespace weft::app
