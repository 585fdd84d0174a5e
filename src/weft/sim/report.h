#pragma once

#include <string>

#include "weft/sim/run.h"

namespace weft {

/// A run as one JSON object, the contract of `simulate --json`.
std::string to_json(const RunReport& report);

/// The columns of frames.csv, one line with its end.
std::string frames_csv_header();
/// One frame as a line of frames.csv.
std::string frames_csv_line(int frame, const FrameReport& report);

}  // namespace weft
